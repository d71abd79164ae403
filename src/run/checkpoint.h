#pragma once
// Numbers and fields as bytes, little-endian on every machine, in the order of the calls; and which program they belong
// to.

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "linalg/sparse.h"
#include "pelage/error.h"
#include "run/program.h"

namespace pelage {

/// Of all that decides how the state of a program goes on: shape, images, equations, lengths, schemes, seeds. When a
/// run stops (Stage::until, steps, stationary) is not part of it: a run may go on for longer than it was meant to.
std::uint64_t fingerprint(const Program& program);

/// Appends to a string.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(std::string& out) : out_(out) {}
  void number(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) out_.push_back(static_cast<char>(value >> shift & 0xff));
  }
  void number(std::int64_t value) { number(static_cast<std::uint64_t>(value)); }
  void number(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void fields(const std::vector<Vector>& fields) {
    number(std::uint64_t{fields.size()});
    for (const Vector& f : fields) {
      number(static_cast<std::uint64_t>(f.size()));
      for (const double value : f) number(value);
    }
  }

 private:
  std::string& out_;
};

/// Error(Fault::input) where the bytes end too early or promise more than there is.
class CheckpointReader {
 public:
  explicit CheckpointReader(const std::string& in, std::size_t at = 0) : in_(in), at_(at) {}
  std::uint64_t count() {
    if (in_.size() - at_ < 8) throw Error(Fault::input, "the checkpoint is cut short");
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 8) value |= std::uint64_t{static_cast<unsigned char>(in_[at_++])} << shift;
    return value;
  }
  std::int64_t integer() { return static_cast<std::int64_t>(count()); }
  double number() { return std::bit_cast<double>(count()); }
  std::vector<Vector> fields() {
    std::vector<Vector> result(limited(count()));
    for (Vector& f : result) {
      f.resize(static_cast<Eigen::Index>(limited(count())));
      for (double& value : f) value = number();
    }
    return result;
  }
  bool at_end() const { return at_ == in_.size(); }

 private:
  std::size_t limited(std::uint64_t count) const {  // every element takes at least eight bytes
    if (count > (in_.size() - at_) / 8) throw Error(Fault::input, "the checkpoint is damaged");
    return static_cast<std::size_t>(count);
  }
  const std::string& in_;
  std::size_t at_;
};

}  // namespace pelage
