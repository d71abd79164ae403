#include "shape/texture.h"

#include <cmath>
#include <utility>

namespace pelage {

namespace {

/// The pixels between whose centres a place lies, along one axis.
struct Neighbours {
  std::size_t first, second;
  double weight;  ///< of the second
};

/// The image reaches from 0 to 1 and repeats; the centre of pixel i lies at (i + 1/2) / count.
Neighbours neighbours(double x, int count) {
  double turn = x - std::floor(x);
  if (!(turn < 1)) turn = 0;  // -1e-20 rounds to 1; what is not a number has no place
  const double place = turn * count - 0.5;
  const double floor = std::floor(place);
  const int first = static_cast<int>(floor);
  return {static_cast<std::size_t>((first + count) % count), static_cast<std::size_t>((first + 1) % count),
          place - floor};
}

}  // namespace

std::array<double, 3> color_at(const Texture& texture, double u, double v) {
  const auto [x0, x1, wx] = neighbours(u, texture.width);
  const auto [y0, y1, wy] = neighbours(1 - v, texture.height);  // rows run downwards
  const auto width = static_cast<std::size_t>(texture.width);
  const std::uint16_t* rgb = texture.rgb->data();
  std::array<double, 3> color;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto pixel = [&](std::size_t x, std::size_t y) { return rgb[3 * (y * width + x) + c] / 65535.0; };
    const double upper = (1 - wx) * pixel(x0, y0) + wx * pixel(x1, y0);
    const double lower = (1 - wx) * pixel(x0, y1) + wx * pixel(x1, y1);
    color[c] = (1 - wy) * upper + wy * lower;
  }
  return color;
}

VertexAttributes texture_attributes(const Texture& texture, const std::vector<Triangle>& triangles,
                                    std::size_t vertices, const Attribute& uv) {
  const auto color = [&](std::size_t tuple) {
    return color_at(texture, uv.values[2 * tuple], uv.values[2 * tuple + 1]);
  };
  auto rgb = vertex_means<3>(triangles, vertices, [&](std::size_t corner) {
    const auto v = static_cast<std::size_t>(triangles[corner / 3][corner % 3]);
    return color(uv.domain == Domain::corner ? corner : v);
  });
  if (triangles.empty() && uv.domain == Domain::vertex)
    for (std::size_t v = 0; v < vertices; ++v)
      for (std::size_t k = 0; k < 3; ++k) rgb[k][v] = color(v)[k];
  const auto names = color_names(texture.name);
  VertexAttributes result;
  for (const std::string& name : names) result[name].resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto values = color_values({rgb[0][v], rgb[1][v], rgb[2][v]});
    for (std::size_t k = 0; k < names.size(); ++k) result[names[k]][v] = values[k];
  }
  return result;
}

}  // namespace pelage
