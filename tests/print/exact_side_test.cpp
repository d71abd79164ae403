#include "print/exact_side.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace pelage {
namespace {

TEST(ExactSide, OfPlainPlaces) {
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(side(a, b, c, {0.2, 0.2, 1}), 1);
  EXPECT_EQ(side(a, b, c, {0.2, 0.2, -1}), -1);
  EXPECT_EQ(side(a, b, c, {5, -3, 0}), 0);
  EXPECT_EQ(turn({0, 0}, {1, 0}, {2, 1}), 1);
  EXPECT_EQ(turn({0, 0}, {1, 0}, {2, -1}), -1);
  EXPECT_EQ(turn({0, 0}, {1, 3}, {2, 6}), 0);
}

/// Beside a line or plane by one unit in the last place, where rounded arithmetic sees nothing.
TEST(ExactSide, SeesTheLastBit) {
  const double up = std::nextafter(12.0, 13.0), down = std::nextafter(12.0, 11.0);
  EXPECT_EQ(turn({0.5, 0.5}, {24, 24}, {12, up}), 1);
  EXPECT_EQ(turn({0.5, 0.5}, {24, 24}, {12, down}), -1);
  EXPECT_EQ(turn({0.5, 0.5}, {24, 24}, {12, 12}), 0);
  const Point a{0.5, 0.5, 0.5}, b{24, 24, 3}, c{17, 17, -8};
  EXPECT_EQ(side(a, b, c, {12, 12, 1e9}), 0);
  EXPECT_EQ(side(a, b, c, {12, up, 1}), -side(a, b, c, {12, down, 1}));
  EXPECT_NE(side(a, b, c, {12, up, 1}), 0);
}

/// (1 + e)(1 - e) is less than 1 by less than a double near 1 can tell.
TEST(ExactSide, SeesWhatProductsRoundAway) {
  const double e = std::ldexp(1, -30);
  EXPECT_EQ(turn({0, 0}, {1 + e, 1}, {1, 1 - e}), -1);
  EXPECT_EQ(turn({0, 0}, {1, 1 - e}, {1 + e, 1}), 1);
}

/// Two corners exchanged turn a triangle over; three in turn do not.
TEST(ExactSide, IsAsAntisymmetricAsDeterminants) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    Point p[4];
    for (std::uint64_t k = 0; k < 12; ++k) p[k / 3][k % 3] = 1 + std::floor(4 * uniform(k, i)) * 1e-16;
    const int s = side(p[0], p[1], p[2], p[3]);
    EXPECT_EQ(side(p[1], p[2], p[0], p[3]), s);
    EXPECT_EQ(side(p[1], p[0], p[2], p[3]), -s);
    EXPECT_EQ(side(p[3], p[1], p[2], p[0]), -s);
  }
}

}  // namespace
}  // namespace pelage
