#include "look/grid_picture.h"

#include <gtest/gtest.h>

#include "pelage/error.h"

namespace pelage {
namespace {

/// Red, green and blue say which node it is.
std::vector<double> places(const Grid& grid) {
  std::vector<double> colors;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v) {
    const Point p = grid.point(v);
    colors.insert(colors.end(), p.begin(), p.end());
  }
  return colors;
}

Point pixel(const Image& image, int x, int y) {
  const float* rgb = &image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
  return {rgb[0], rgb[1], rgb[2]};
}

Grid block(std::int32_t nx, std::int32_t ny, std::int32_t nz) {
  Grid grid;
  grid.count = {nx, ny, nz};
  return grid;
}

TEST(GridPicture, ASheetHasYUpwards) {
  const Grid grid = block(4, 3, 1);
  const Image image = grid_image(grid, places(grid));
  ASSERT_EQ(image.width, 4);
  ASSERT_EQ(image.height, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(pixel(image, x, y), (Point{double(x), 2.0 - y, 0}));
}

TEST(GridPicture, ALineIsARowAndAStripOfAnyHeight) {
  const Grid grid = block(5, 1, 1);
  const Image row = grid_image(grid, places(grid));
  EXPECT_EQ(row.height, 1);
  const Image strip = zoomed(row, 2, 16);
  ASSERT_EQ(strip.width, 10);
  ASSERT_EQ(strip.height, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 10; ++x) EXPECT_EQ(pixel(strip, x, y), (Point{double(x / 2), 0, 0}));
}

TEST(GridPicture, TheCutsOfABlockGoThroughItsMiddle) {
  const Grid grid = block(4, 3, 5);
  const Image image = grid_image(grid, places(grid));
  ASSERT_EQ(image.width, 4 + 2 + 5);
  ASSERT_EQ(image.height, 5 + 2 + 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      Point wanted{1, 1, 1};
      if (x < 4 && y < 5) wanted = {double(x), 1, 4.0 - y};
      if (x < 4 && y >= 7) wanted = {double(x), 9.0 - y, 2};
      if (x >= 6 && y >= 7) wanted = {2, 9.0 - y, x - 6.0};
      EXPECT_EQ(pixel(image, x, y), wanted) << x << ' ' << y;
    }
}

TEST(GridPicture, TimeRunsDownwards) {
  const Image image = space_time_image({{0, 0, 0, 1, 1, 1}, {2, 2, 2, 3, 3, 3}, {4, 4, 4, 5, 5, 5}});
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 3);
  EXPECT_EQ(pixel(image, 1, 2), (Point{5, 5, 5}));
  EXPECT_EQ(pixel(image, 0, 1), (Point{2, 2, 2}));
}

/// What is laid three times is the periodic continuation: shifted by the tile it is the same.
TEST(GridPicture, TilesAreLaidSideBySide) {
  const Grid grid = block(4, 3, 1);
  const Image one = grid_image(grid, places(grid)), many = replicated(one, 3, 2);
  ASSERT_EQ(many.width, 12);
  ASSERT_EQ(many.height, 6);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 12; ++x) EXPECT_EQ(pixel(many, x, y), pixel(one, x % 4, y % 3));
  EXPECT_THROW(replicated(one, 1000000000, 1), Error);
}

TEST(GridPicture, GreysReachFromTheLowestToTheHighest) {
  EXPECT_EQ(greys({-1, 0, 1, 2, 3, 4}, 0, 2), (std::vector<std::uint16_t>{0, 0, 32768, 65535, 65535, 65535}));
  EXPECT_EQ(greys({7}, 7, 7), (std::vector<std::uint16_t>{0}));
}

}  // namespace
}  // namespace pelage
