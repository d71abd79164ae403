#include "look/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "look/flat_tile.h"

namespace pelage {
namespace {

/// The unit square as two triangles, its colours linear in x and y.
TriangleMesh gradient_square() {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.set({"color", 3, Domain::vertex, {0, 0, 0.5, 1, 0, 0.5, 1, 1, 0.5, 0, 1, 0.5}});
  return mesh;
}

TEST(FlatTile, ReproducesLinearColoursWithYUpwards) {
  constexpr int size = 16;
  const Image tile = flat_tile(gradient_square(), size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float* pixel = &tile.rgb[static_cast<std::size_t>(3 * (y * size + x))];
      EXPECT_NEAR(pixel[0], (x + 0.5) / size, 1e-6);
      EXPECT_NEAR(pixel[1], 1 - (y + 0.5) / size, 1e-6);
      EXPECT_NEAR(pixel[2], 0.5, 1e-6);
    }
}

TEST(ContactSheet, TilesStandInOrderWithTheLowestRowBelow) {
  ContactSheet sheet;
  sheet.tile = 50;
  sheet.x = {"1", "2", "3"};
  sheet.y = {"10", "20"};
  for (int c = 0; c < 6; ++c) {
    Image flat{50, 50, std::vector<float>(3 * 50 * 50, 0.0F)};
    for (std::size_t i = 0; i < flat.rgb.size(); i += 3) flat.rgb[i] = 0.1F * static_cast<float>(c + 1);
    sheet.cells.push_back({flat, "", false});
  }
  const Image image = draw(sheet);
  std::vector<float> order;  // reds as they first appear, from the top left
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    if (image.rgb[i + 1] == 0 && image.rgb[i] > 0.05F &&
        std::none_of(order.begin(), order.end(), [&](float r) { return std::abs(r - image.rgb[i]) < 0.01F; }))
      order.push_back(image.rgb[i]);
  ASSERT_EQ(order.size(), 6u);
  const float expected[] = {0.4F, 0.5F, 0.6F, 0.1F, 0.2F, 0.3F};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(order[i], expected[i], 1e-3);
}

TEST(ContactSheet, SheetsAreAboutOnePageLarge) {
  for (const int columns : {1, 6, 20}) {
    ContactSheet sheet;
    sheet.tile = sheet_tile(columns, 2);
    sheet.x.assign(static_cast<std::size_t>(columns), "0.25");
    sheet.y = {"1", "2"};
    sheet.cells.assign(2 * static_cast<std::size_t>(columns), {{}, "uniform", true});
    const Image image = draw(sheet);
    EXPECT_LE(image.width, 1800);
    EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(3 * image.width * image.height));
  }
}

}  // namespace
}  // namespace pelage
