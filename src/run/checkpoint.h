#pragma once
// Numbers and fields as bytes, little-endian on every machine, in the order of the calls; and which program they belong
// to.

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "linalg/sparse.h"
#include "pelage/error.h"
#include "run/program.h"

namespace pelage {

/// Something that decides how the state of a program goes on, in words; a hash where words would not do.
struct Trait {
  std::string name, value;
};
using Traits = std::vector<Trait>;

/// All of them: shape, images, equations, lengths, schemes, seeds, motion. When a run stops (Stage::until, steps,
/// stationary) is not among them: a run may go on for longer than it was meant to.
Traits traits_of(const Program& program);

/// Those that are told in words and are there.
Traits told(Traits traits);

/// The first that differs, "seed 1 instead of 2"; empty where none does.
std::string difference(const Traits& checkpoint, const Traits& run);

inline constexpr std::size_t seal_length = 8;

/// With a checksum of that many bytes behind them.
std::string seal(std::string bytes);
/// Whether there is one and it is right.
bool is_sealed(std::string_view bytes);

/// Appends to a string.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(std::string& out) : out_(out) {}
  void number(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) out_.push_back(static_cast<char>(value >> shift & 0xff));
  }
  void number(std::int64_t value) { number(static_cast<std::uint64_t>(value)); }
  void number(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void text(std::string_view text) {
    number(std::uint64_t{text.size()});
    out_ += text;
  }
  void traits(const Traits& traits) {
    number(std::uint64_t{traits.size()});
    for (const Trait& t : traits) {
      text(t.name);
      text(t.value);
    }
  }
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
  std::string text() {
    const std::uint64_t length = count();
    if (length > in_.size() - at_) throw Error(Fault::input, "the checkpoint is damaged");
    at_ += length;
    return in_.substr(at_ - length, length);
  }
  Traits traits() {
    Traits result(limited(count()));
    for (Trait& t : result) {
      t.name = text();
      t.value = text();
    }
    return result;
  }
  std::vector<Vector> fields() {
    std::vector<Vector> result(limited(count()));
    for (Vector& f : result) {
      f.resize(static_cast<Eigen::Index>(limited(count())));
      for (double& value : f) value = number();
    }
    return result;
  }
  /// Before the checksum.
  bool at_end() const { return at_ + seal_length == in_.size(); }

 private:
  std::size_t limited(std::uint64_t count) const {  // every element takes at least eight bytes
    if (count > (in_.size() - at_) / 8) throw Error(Fault::input, "the checkpoint is damaged");
    return static_cast<std::size_t>(count);
  }
  const std::string& in_;
  std::size_t at_;
};

}  // namespace pelage
