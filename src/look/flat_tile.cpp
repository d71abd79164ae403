#include "look/flat_tile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace pelage {

namespace {

using Corner = std::array<double, 2>;

double doubled_area(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/// Pixels whose centres lie in the triangle (corners in pixels) get the colours of its corners, interpolated.
void fill_triangle(Image& image, const std::array<Corner, 3>& at, const std::array<const double*, 3>& color) {
  const double area = doubled_area(at[0], at[1], at[2]);
  if (area == 0) return;
  const auto clamped = [&](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  const auto [left, right] = std::minmax({at[0][0], at[1][0], at[2][0]});
  const auto [top, bottom] = std::minmax({at[0][1], at[1][1], at[2][1]});
  for (int y = clamped(std::floor(top - 0.5), image.height); y < clamped(std::ceil(bottom + 0.5), image.height); ++y)
    for (int x = clamped(std::floor(left - 0.5), image.width); x < clamped(std::ceil(right + 0.5), image.width); ++x) {
      const Corner p = {x + 0.5, y + 0.5};
      const double a = doubled_area(p, at[1], at[2]) / area, b = doubled_area(at[0], p, at[2]) / area, c = 1 - a - b;
      constexpr double slack = -1e-9;  // pixels on an edge belong to both triangles
      if (a < slack || b < slack || c < slack) continue;
      float* pixel = &image.rgb[std::size_t{3} * (static_cast<std::size_t>(y) * image.width + x)];
      for (std::size_t k = 0; k < 3; ++k)
        pixel[k] = static_cast<float>(a * color[0][k] + b * color[1][k] + c * color[2][k]);
    }
}

}  // namespace

Image flat_tile(const TriangleMesh& mesh, int size) {
  const Attribute* colors = mesh.find("color");
  assert(colors && colors->components == 3);
  Image image{size, size, std::vector<float>(std::size_t{3} * size * size)};
  for (const Triangle& t : mesh.triangles) {
    std::array<Corner, 3> at;
    std::array<const double*, 3> color;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& p = mesh.points[static_cast<std::size_t>(t[k])];
      at[k] = {p[0] * size, (1 - p[1]) * size};
      color[k] = &colors->values[3 * static_cast<std::size_t>(t[k])];
    }
    fill_triangle(image, at, color);
  }
  return image;
}

}  // namespace pelage
