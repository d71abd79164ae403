// Rasters on which charts find their places, and charts that are laid side by side.

#include "unwrap/pack.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pelage/error.h"
#include "unwrap/outline.h"
#include "unwrap/raster.h"

namespace pelage {
namespace {

TEST(Raster, MasksHoldEveryCellThatATriangleTouches) {
  const Mask mask({{0, 1, 2}}, {{0.5, 0.5}, {7.5, 0.5}, {0.5, 3.5}});
  ASSERT_EQ(mask.width(), 8);
  ASSERT_EQ(mask.height(), 4);
  const std::int32_t ends[] = {8, 7, 5, 2};  // where the long side leaves the row at its foot: 7.5 - 7 (y - 0.5) / 3
  for (std::int32_t y = 0; y < 4; ++y) {
    ASSERT_EQ(mask.row(y).size(), 1U);
    EXPECT_EQ(mask.row(y)[0].begin, 0);
    EXPECT_EQ(mask.row(y)[0].end, ends[y]) << y;
  }
}

TEST(Raster, TheLowestFreePlaceIsFound) {
  const std::vector<Triangle> square = {{0, 1, 2}, {0, 2, 3}};
  const auto block = [&](double w, double h) {
    return Mask(square, {{0.1, 0.1}, {w - 0.1, 0.1}, {w - 0.1, h - 0.1}, {0.1, h - 0.1}});
  };
  Raster raster(10, 1);
  raster.take(block(3, 2), {1, 1}, 1);
  const auto beside = raster.lowest_place(block(4, 4));
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->x, 5);
  EXPECT_EQ(beside->y, 1);
  raster.take(block(4, 4), *beside, 1);
  const auto above = raster.lowest_place(block(5, 3));
  ASSERT_TRUE(above);
  EXPECT_EQ(above->x, 1);
  EXPECT_EQ(above->y, 6);
  EXPECT_FALSE(raster.lowest_place(block(9, 1)));
}

/// A rectangle turned by an angle.
Chart rectangle(double w, double h, double angle) {
  Chart chart;
  chart.triangles = {{0, 1, 2}, {0, 2, 3}};
  chart.uv = turned({{0, 0}, {w, 0}, {w, h}, {0, h}}, std::cos(angle), std::sin(angle));
  chart.area = w * h;
  return chart;
}

TEST(Pack, TurnedRectanglesFillASquareBetweenThem) {
  std::vector<Chart> charts = {rectangle(2, 1, 0.3), rectangle(2, 1, 1.1), rectangle(2, 1, 2), rectangle(2, 1, 0)};
  const double scale = pack(charts, 1024, 0);
  double area = 0;
  for (const Chart& c : charts) {
    area += area_of({c.uv[0], c.uv[1], c.uv[2]}) + area_of({c.uv[0], c.uv[2], c.uv[3]});
    EXPECT_NEAR(std::hypot(c.uv[1][0] - c.uv[0][0], c.uv[1][1] - c.uv[0][1]), 2 * scale, 1e-6);
  }
  EXPECT_GT(area, 0.45);  // side by side they are 4 long: half of the square
  EXPECT_LE(area, 1);
}

TEST(Pack, HearsAWishToStopWithinATrial) {
  std::vector<Chart> charts(20, rectangle(2, 1, 0));
  int asked = 0;
  const Progress third_time = [&](std::string_view, double) { return ++asked < 3; };
  EXPECT_THROW(pack(charts, 1024, 0, third_time), Error);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace pelage
