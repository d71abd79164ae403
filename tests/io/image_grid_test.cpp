#include "io/image_grid.h"

#include <gtest/gtest.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

#include <cmath>

#include "base/srgb.h"
#include "io/exr_writer.h"
#include "io/grid_file.h"
#include "io/png_writer.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "shape/scalar_attributes.h"

namespace pelage {
namespace {

constexpr int width = 7, height = 5;

std::string png_of(int channels, const std::vector<unsigned char>& pixels, int w = width, int h = height) {
  std::string bytes;
  stbi_write_png_to_func(
      [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
      },
      &bytes, w, h, channels, pixels.data(), w * channels);
  return bytes;
}

TEST(ImageGrid, PixelsAreNodesAndYPointsUp) {
  for (int channels = 1; channels <= 4; ++channels) {
    std::vector<unsigned char> pixels;
    for (int i = 0; i < channels * width * height; ++i) pixels.push_back(static_cast<unsigned char>(11 * i));
    const GridFile file = read_grid_bytes(png_of(channels, pixels), "a.png");
    EXPECT_EQ(file.grid.count, (std::array{width, height, 1}));
    EXPECT_EQ(file.grid.point(width), (Point{0, 1, 0}));
    ASSERT_EQ(file.findings.size(), 1U);
    EXPECT_EQ(file.findings[0].kind, "unit");
    const Attribute& color = *file.grid.find("color");
    ASSERT_EQ(color.components, channels % 2 == 0 ? 4 : 3);
    EXPECT_EQ(color.type, NumberType::uint8);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        for (int k = 0; k < color.components; ++k) {
          const int from = k == 3 ? channels - 1 : channels > 2 ? k : 0;
          const double stored = pixels[channels * ((height - 1 - j) * width + i) + from] / 255.0;
          EXPECT_EQ(color.values[color.components * (j * width + i) + k], k == 3 ? stored : linear_from_srgb(stored));
        }
  }
}

TEST(ImageGrid, AnAlphaThatHidesNothingIsLeftOut) {
  EXPECT_EQ(read_grid_bytes(png_of(2, std::vector<unsigned char>(2 * width * height, 255)), "a.png")
                .grid.find("color")
                ->components,
            3);
}

TEST(ImageGrid, GreysOfSixteenBitsKeepThemAll) {
  std::vector<std::uint16_t> grey(256 * 256);
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<std::uint16_t>(i * 7919);
  const Grid grid = read_grid_bytes(grey_png_bytes(256, 256, grey), "a.png").grid;
  EXPECT_EQ(grid.find("color")->type, NumberType::uint16);
  const VertexAttributes named = scalar_attributes(grid.attributes, {}, grid.nodes());
  for (std::size_t j = 0; j < 256; ++j)
    for (std::size_t i = 0; i < 256; ++i) {
      const double stored = grey[(255 - j) * 256 + i];
      ASSERT_NEAR(65535 * named.at("color")[256 * j + i], stored, 1e-9);
      ASSERT_EQ(std::lround(65535 * named.at("color_1")[256 * j + i]), std::lround(stored));
    }
}

TEST(ImageGrid, AnImageThatBecomesAGridAndAnImageAgainIsTheSame) {
  Image image{256, 257, {}};
  for (std::size_t i = 0; i < 3 * 256 * 257; ++i)
    image.rgb.push_back(static_cast<float>(linear_from_srgb(static_cast<double>(i % 65536) / 65535)));
  const std::string deep = deep_png_bytes(image), plain = png_bytes(image);
  EXPECT_EQ(grid_png_bytes(read_grid_bytes(deep, "a.png").grid), deep);
  EXPECT_EQ(grid_png_bytes(read_grid_bytes(plain, "a.png").grid), plain);
}

TEST(ImageGrid, ExrHoldsEveryComponentUnderItsName) {
  Grid grid;
  grid.count = {3, 2, 1};
  grid.set({"u", 1, Domain::vertex, {0, 1, 2, 3, 4, 5}});
  grid.set({"flow", 2, Domain::vertex, {0, 9, 1, 9, 2, 9, 3, 8, 4, 8, 5, 8}});
  grid.set({"color", 4, Domain::vertex, std::vector<double>(24, 0.5)});
  const std::vector<float> u = {3, 4, 5, 0, 1, 2}, half(6, 0.5F);  // the highest row first
  EXPECT_EQ(grid_exr_bytes(grid), exr_bytes({"u", "flow_1", "flow_2", "R", "G", "B", "A"},
                                            {u, u, {8, 8, 8, 9, 9, 9}, half, half, half, half}, 3, 2));
}

TEST(ImageGrid, WhatIsNoImageIsRefused) {
  Grid grid;
  grid.count = {3, 2, 1};
  EXPECT_THROW(grid_png_bytes(grid), Error);
  EXPECT_THROW(grid_exr_bytes(grid), Error);
  grid.count = {3, 2, 2};
  grid.set({"color", 3, Domain::vertex, std::vector<double>(36)});
  EXPECT_THROW(grid_png_bytes(grid), Error);
  EXPECT_THROW(grid_exr_bytes(grid), Error);
}

TEST(ImageGrid, OnePixelWideIsRefused) {
  const auto of_size = [](int w, int h) {
    return read_grid_bytes(png_of(1, std::vector<unsigned char>(w * h, 9), w, h), "a.png").grid.count;
  };
  EXPECT_EQ(of_size(2, 1), (std::array{2, 1, 1}));
  EXPECT_THROW(of_size(1, 2), Error);
}

}  // namespace
}  // namespace pelage
