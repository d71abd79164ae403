#include "look/grid_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/checked.h"
#include "shape/grid_rows.h"

namespace pelage {

namespace {

constexpr std::size_t channels = 3;

int times(int size, int factor) {
  assert(factor >= 1);
  return checked_count<int>(std::int64_t{size} * factor, "pixels along a side of the picture");
}

/// A picture of that size whose pixels are those that from(x, y) names.
template <class From>
Image picked(const Image& image, int width, int height, From&& from) {
  Image result{width, height, {}};
  result.rgb.reserve(channels * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto [i, j] = from(x, y);
      const float* pixel = &image.rgb[channels * (static_cast<std::size_t>(j) * image.width + i)];
      result.rgb.insert(result.rgb.end(), pixel, pixel + channels);
    }
  return result;
}

/// A plane of a block: its axes to the right and upwards, and the place along the third.
struct Cut {
  std::size_t right, up, through;
  int left, top;  ///< of its first pixel
};

void draw(Image& image, const Grid& grid, const std::vector<double>& colors, const Cut& cut) {
  std::array<std::int32_t, 3> at{};
  at[cut.through] = grid.count[cut.through] / 2;
  for (std::int32_t y = 0; y < grid.count[cut.up]; ++y)
    for (std::int32_t x = 0; x < grid.count[cut.right]; ++x) {
      at[cut.right] = x;
      at[cut.up] = grid.count[cut.up] - 1 - y;
      const double* color = &colors[channels * static_cast<std::size_t>(grid.node(at[0], at[1], at[2]))];
      std::copy_n(color, channels,
                  &image.rgb[channels * (static_cast<std::size_t>(cut.top + y) * image.width + (cut.left + x))]);
    }
}

}  // namespace

Image grid_image(const Grid& grid, const std::vector<double>& colors) {
  if (grid.dimension() == 3) return cut_planes(grid, colors);
  return {grid.count[0], grid.count[1], in_rows(grid, colors, channels, 0, channels)};
}

Image cut_planes(const Grid& grid, const std::vector<double>& colors) {
  assert(colors.size() == channels * grid.nodes());
  constexpr int gap = 2;  // pixels
  const auto [nx, ny, nz] = grid.count;
  Image image{nx + gap + nz, nz + gap + ny, {}};
  image.rgb.assign(channels * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 1.0F);
  constexpr std::size_t x = 0, y = 1, z = 2;
  for (const Cut& cut : {Cut{x, y, z, 0, nz + gap}, Cut{x, z, y, 0, 0}, Cut{z, y, x, nx + gap, nz + gap}})
    draw(image, grid, colors, cut);
  return image;
}

Image space_time_image(const std::vector<std::vector<double>>& colors) {
  assert(!colors.empty());
  Image image{static_cast<int>(colors[0].size() / channels), static_cast<int>(colors.size()), {}};
  for (const std::vector<double>& row : colors) {
    assert(row.size() == colors[0].size());
    for (const double value : row) image.rgb.push_back(static_cast<float>(value));
  }
  return image;
}

Image zoomed(const Image& image, int across, int down) {
  return picked(image, times(image.width, across), times(image.height, down), [&](int x, int y) {
    return std::array{x / across, y / down};
  });
}

Image replicated(const Image& image, int across, int down) {
  return picked(image, times(image.width, across), times(image.height, down), [&](int x, int y) {
    return std::array{x % image.width, y % image.height};
  });
}

std::vector<std::uint16_t> greys(const std::vector<double>& values, double low, double high) {
  constexpr double white = 65535;
  std::vector<std::uint16_t> result;
  result.reserve(values.size());
  for (const double value : values) {
    const double grey = high == low ? 0 : (value - low) / (high - low);
    result.push_back(static_cast<std::uint16_t>(std::lround(white * std::clamp(grey, 0.0, 1.0))));
  }
  return result;
}

}  // namespace pelage
