#pragma once
// Convolution of bits with two integer kernels at once.

#include <cstdint>
#include <vector>

#include "discretise/lattice.h"

namespace pelage {

/// Weights at the offsets (-reach[0] .. reach[0]) x (-reach[1] .. reach[1]), row by row, of two kernels in one number:
/// first + 2^16 second. All weights of a kernel add up to less than 2^16.
struct PairedKernel {
  std::array<std::size_t, 2> reach{};
  std::vector<std::uint32_t> weight;
};

/// sum(x, y) = sum of weight(dx, dy) bit(x + dx, y + dy) on the nodes of a lattice of one or two axes, continued behind
/// its borders. As all numbers are integers, the sums are exact in any order: they are the same bits wherever a tile is
/// cut, however they were found.
class BinaryConvolution {
 public:
  BinaryConvolution(const Lattice& lattice, PairedKernel kernel);

  /// Takes these bits, a 0 or 1 per node, of which there were zeros before, and returns how many have changed, those
  /// that stand for places behind a border counted there, too. Where they are few their
  /// weights are added to the sums before, else sums are found anew, by table lookups of eight bits at once.
  std::size_t update(const std::vector<std::uint8_t>& bits);
  const std::vector<std::uint32_t>& sums() const { return sums_; }

 private:
  std::size_t across() const { return 2 * kernel_.reach[0] + 1; }
  void look_up_row(std::size_t y);
  void list_changes(const std::vector<std::uint8_t>& bits, std::size_t y);
  void add_changes(std::size_t y);
  void pack(std::size_t y);

  std::array<std::size_t, 2> count_;
  PairedKernel kernel_;
  /// Which node the places -reach .. count + reach of an axis stand for.
  std::array<std::vector<std::size_t>, 2> node_;
  std::vector<std::vector<std::size_t>> places_;  ///< the other way round, along the first axis
  struct Span {
    std::size_t first, last;  ///< one behind
  };
  std::vector<Span> used_;            ///< where weights are not 0, per row of the kernel
  std::size_t pieces_;                ///< bytes per row of the kernel
  std::vector<std::uint32_t> table_;  ///< by row of the kernel, piece and byte
  std::size_t row_bytes_;
  std::vector<std::uint8_t> packed_;  ///< eight places to a byte, per row
  std::vector<std::uint8_t> bits_;
  struct Change {
    std::size_t place;   ///< along the row
    std::uint32_t sign;  ///< 1 or -1
  };
  std::vector<std::vector<Change>> changes_;  ///< per row
  std::vector<std::uint32_t> sums_;
};

}  // namespace pelage
