#include "time/binary_convolution.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace pelage {
namespace {

/// With rows and places of 0.
PairedKernel random_kernel(std::size_t rx, std::size_t ry) {
  PairedKernel kernel{{rx, ry}, {}};
  for (std::uint64_t k = 0; k < (2 * rx + 1) * (2 * ry + 1); ++k)
    if (uniform(3, k / (2 * rx + 1)) < 0.3 || uniform(4, k) < 0.2)
      kernel.weight.push_back(0);
    else
      kernel.weight.push_back(static_cast<std::uint32_t>(50 * uniform(1, k)) +
                              (static_cast<std::uint32_t>(50 * uniform(2, k)) << 16));
  return kernel;
}

/// The node that a place stands for.
std::size_t node(std::ptrdiff_t place, std::size_t count, bool periodic) {
  const auto n = static_cast<std::ptrdiff_t>(count), period = periodic ? n : std::max<std::ptrdiff_t>(1, 2 * (n - 1));
  const std::ptrdiff_t at = (place % period + period) % period;
  return static_cast<std::size_t>(at < n ? at : period - at);
}

std::vector<std::uint32_t> plain(const Lattice& l, const PairedKernel& kernel, const std::vector<std::uint8_t>& bits) {
  std::vector<std::uint32_t> sums(bits.size());
  const auto rx = static_cast<std::ptrdiff_t>(kernel.reach[0]), ry = static_cast<std::ptrdiff_t>(kernel.reach[1]);
  for (std::size_t k = 0; k < bits.size(); ++k)
    for (std::ptrdiff_t dy = -ry; dy <= ry; ++dy)
      for (std::ptrdiff_t dx = -rx; dx <= rx; ++dx) {
        const std::size_t x = node(static_cast<std::ptrdiff_t>(k % l.count[0]) + dx, l.count[0], l.periodic[0]);
        const std::size_t y = node(static_cast<std::ptrdiff_t>(k / l.count[0]) + dy, l.count[1], l.periodic[1]);
        sums[k] +=
            bits[x + l.count[0] * y] * kernel.weight[static_cast<std::size_t>((dy + ry) * (2 * rx + 1) + dx + rx)];
      }
  return sums;
}

/// By lookups and by changes, kernels of one byte to nine and wider than the grid, periodic and closed: every sum is
/// that of the plain convolution.
TEST(BinaryConvolution, IsThePlainOneBitForBit) {
  for (const auto& [n, m, px, py, rx, ry] : {std::tuple{40, 30, true, true, 3, 2},
                                             {37, 9, true, false, 11, 4},
                                             {24, 12, false, true, 35, 1},
                                             {9, 10, false, false, 12, 11},
                                             {50, 1, true, false, 5, 0}}) {
    const Lattice lattice{{static_cast<std::size_t>(n), static_cast<std::size_t>(m), 1}, {px, py, false}, {1, 1, 1}};
    const PairedKernel kernel = random_kernel(static_cast<std::size_t>(rx), static_cast<std::size_t>(ry));
    BinaryConvolution convolution(lattice, kernel);
    std::vector<std::uint8_t> bits(lattice.nodes());
    for (std::uint64_t round = 0; round < 6; ++round) {
      const double share = round % 2 ? 0.05 : 0.5;  // of the bits that are thrown anew
      for (std::size_t k = 0; k < bits.size(); ++k)
        if (uniform(round + 10, k) < share) bits[k] = uniform(round + 20, k) < 0.5;
      convolution.update(bits);
      ASSERT_EQ(convolution.sums(), plain(lattice, kernel, bits)) << n << " " << rx << " " << round;
      EXPECT_EQ(convolution.update(bits), 0);
    }
  }
}

}  // namespace
}  // namespace pelage
