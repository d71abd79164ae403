#include "shape/scalar_attributes.h"

#include "base/srgb.h"

namespace pelage {

namespace {

std::vector<double> at_vertices(const Attribute& a, std::size_t component, const std::vector<Triangle>& triangles,
                                std::size_t vertices) {
  const auto n = static_cast<std::size_t>(a.components);
  std::vector<double> values;
  if (a.domain == Domain::vertex) {
    for (std::size_t i = component; i < a.values.size(); i += n) values.push_back(a.values[i]);
    return values;
  }
  const std::size_t corners_per_tuple = a.domain == Domain::corner ? 1 : 3;
  auto mean = vertex_means<1>(triangles, vertices, [&](std::size_t corner) {
    return std::array{a.values[n * (corner / corners_per_tuple) + component]};
  });
  return std::move(mean[0]);
}

void add_color(const Attribute& color, const std::vector<Triangle>& triangles, std::size_t vertices,
               VertexAttributes& result) {
  Attribute painted = color;
  const auto n = static_cast<std::size_t>(color.components);
  for (std::size_t i = 0; i < painted.values.size(); ++i)
    if (i % n < 3) painted.values[i] = srgb_from_linear(painted.values[i]);
  std::array<std::vector<double>, 3> rgb;
  for (std::size_t k = 0; k < 3; ++k) rgb[k] = at_vertices(painted, k, triangles, vertices);
  const auto names = color_names(color.name);
  std::array<std::vector<double>*, names.size()> lists;
  for (std::size_t k = 0; k < names.size(); ++k) lists[k] = &result[names[k]];
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto values = color_values({rgb[0][v], rgb[1][v], rgb[2][v]});
    for (std::size_t k = 0; k < names.size(); ++k) lists[k]->push_back(values[k]);
  }
  if (n == 4) result[color.name + "_4"] = at_vertices(painted, 3, triangles, vertices);
}

}  // namespace

std::array<std::string, 7> color_names(const std::string& name) {
  return {name, name + "_1", name + "_2", name + "_3", name + "_linear_1", name + "_linear_2", name + "_linear_3"};
}

std::array<double, 7> color_values(const std::array<double, 3>& c) {
  return {0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2],
          c[0],
          c[1],
          c[2],
          linear_from_srgb(c[0]),
          linear_from_srgb(c[1]),
          linear_from_srgb(c[2])};
}

VertexAttributes scalar_attributes(const std::vector<Attribute>& attributes, const std::vector<Triangle>& triangles,
                                   std::size_t vertices) {
  VertexAttributes result;
  for (const Attribute& a : attributes) {
    if (is_color(a)) {
      add_color(a, triangles, vertices, result);
      continue;
    }
    const auto components = static_cast<std::size_t>(a.components);
    for (std::size_t c = 0; c < components; ++c)
      result[components == 1 ? a.name : a.name + "_" + std::to_string(c + 1)] = at_vertices(a, c, triangles, vertices);
  }
  return result;
}

}  // namespace pelage
