#include "shape/places.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelage {
namespace {

TEST(SamePlaces, SmallestNumberOfThoseCompared) {
  const std::vector<Point> points = {
      {1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {-0.0, 0, -0.0}, {1, 2, 3}, {std::nan(""), 0, 0}, {std::nan(""), 0, 0}};
  EXPECT_EQ(same_places(points, std::vector<char>(7, 1)), (std::vector<std::int32_t>{0, 1, 0, 1, 0, 5, 6}));
  EXPECT_EQ(same_places(points, {0, 1, 1, 0, 1, 1, 1}), (std::vector<std::int32_t>{0, 1, 2, 3, 2, 5, 6}));
}

}  // namespace
}  // namespace pelage
