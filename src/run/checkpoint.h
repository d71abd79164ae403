#pragma once
// Numbers and fields as bytes: little-endian, in the order of the calls.

#include <cstring>
#include <string>
#include <vector>

#include "linalg/sparse.h"
#include "pelage/error.h"

namespace pelage {

/// Appends to a string.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(std::string& out) : out_(out) {}
  template <class T>
  void number(T value) {
    out_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void fields(const std::vector<Vector>& fields) {
    number(static_cast<std::uint64_t>(fields.size()));
    for (const Vector& f : fields) {
      number(static_cast<std::uint64_t>(f.size()));
      out_.append(reinterpret_cast<const char*>(f.data()), static_cast<std::size_t>(f.size()) * sizeof(double));
    }
  }

 private:
  std::string& out_;
};

/// Error(Fault::input) where the bytes end too early or promise more than there is.
class CheckpointReader {
 public:
  explicit CheckpointReader(const std::string& in) : in_(in) {}
  void bytes(void* target, std::size_t count) {
    if (count > in_.size() - at_) throw Error(Fault::input, "the checkpoint is cut short");
    std::memcpy(target, in_.data() + at_, count);
    at_ += count;
  }
  template <class T>
  T number() {
    T value;
    bytes(&value, sizeof value);
    return value;
  }
  std::vector<Vector> fields() {
    std::vector<Vector> result(limited(number<std::uint64_t>()));
    for (Vector& f : result) {
      f.resize(static_cast<Eigen::Index>(limited(number<std::uint64_t>())));
      bytes(f.data(), static_cast<std::size_t>(f.size()) * sizeof(double));
    }
    return result;
  }
  bool at_end() const { return at_ == in_.size(); }

 private:
  std::size_t limited(std::uint64_t count) const {  // every element takes at least eight bytes
    if (count > (in_.size() - at_) / sizeof(double)) throw Error(Fault::input, "the checkpoint is damaged");
    return static_cast<std::size_t>(count);
  }
  const std::string& in_;
  std::size_t at_ = 0;
};

}  // namespace pelage
