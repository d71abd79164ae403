#include "render/sampler.h"

#include <gtest/gtest.h>

#include <set>

namespace pelage {
namespace {

/// Do 2^m points fill each of the 2^m boxes of 2^a x 2^(m-a) once, for every a?
void expect_net(std::uint32_t first, std::uint32_t m, std::uint32_t seed) {
  for (std::uint32_t a = 0; a <= m; ++a) {
    std::set<std::pair<int, int>> boxes;
    for (std::uint32_t i = 0; i < (1U << m); ++i) {
      const auto p = scrambled_sobol(first + i, seed);
      ASSERT_TRUE(p[0] >= 0 && p[0] < 1 && p[1] >= 0 && p[1] < 1);
      boxes.insert({static_cast<int>(p[0] * static_cast<float>(1U << a)),
                    static_cast<int>(p[1] * static_cast<float>(1U << (m - a)))});
    }
    EXPECT_EQ(boxes.size(), std::size_t{1} << m) << "first " << first << " m " << m << " a " << a;
  }
}

TEST(Sampler, AlignedBlocksFillAllElementaryBoxes) {
  for (std::uint32_t m : {0U, 1U, 4U, 5U, 8U})
    for (std::uint32_t block : {0U, 1U, 12345U}) expect_net(block << m, m, 77 + block);
}

TEST(Sampler, SeedsGiveUnrelatedPoints) {
  double product = 0;
  for (std::uint32_t i = 0; i < 4096; ++i)
    product += (scrambled_sobol(i, 1)[0] - 0.5) * (scrambled_sobol(i, 2)[0] - 0.5) / 4096;
  EXPECT_NEAR(product * 12, 0, 0.06);  // correlation; its standard deviation is 1/64
}

TEST(Sampler, ZOrder) {
  EXPECT_EQ(z_order(0, 0), 0U);
  EXPECT_EQ(z_order(1, 0), 1U);
  EXPECT_EQ(z_order(0, 1), 2U);
  EXPECT_EQ(z_order(7, 7), 63U);
  EXPECT_EQ(z_order(0xffff, 0), 0x55555555U);
}

}  // namespace
}  // namespace pelage
