#pragma once
// The attributes of a mesh as formulas name them.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Values at the vertices, by the name that attribute(NAME) uses.
using VertexAttributes = std::map<std::string, std::vector<double>>;

/// By which formulas know a colour NAME, of the shape or of an image: "NAME", the luminance (Rec. 709), and "NAME_1",
/// "NAME_2", "NAME_3", red, green and blue, all as painted (sRGB, 128 of 255 is 0.502); "NAME_linear_1" ... are red,
/// green and blue as linear light.
std::array<std::string, 7> color_names(const std::string& name);

/// The values of these names, in their order, from red, green and blue as painted.
std::array<double, 7> color_values(const std::array<double, 3>& painted);

/// The attributes of a mesh, each component by itself: "mask", or "flow_1", "flow_2"; colours by color_names, and their
/// fourth component as "color_4". Those of corners and faces are means over the corners that meet at a vertex.
VertexAttributes scalar_attributes(const std::vector<Attribute>& attributes, const std::vector<Triangle>& triangles,
                                   std::size_t vertices);
inline VertexAttributes scalar_attributes(const TriangleMesh& mesh) {
  return scalar_attributes(mesh.attributes, mesh.triangles, mesh.points.size());
}

/// The mean at every vertex over its corners of the tuples that tuple(corner) gives; 0 at vertices without a triangle.
template <std::size_t N, class Tuple>
std::array<std::vector<double>, N> vertex_means(const std::vector<Triangle>& triangles, std::size_t vertices,
                                                Tuple&& tuple) {
  std::array<std::vector<double>, N> mean;
  mean.fill(std::vector<double>(vertices, 0.0));
  std::vector<double> corners(vertices, 0);
  for (std::size_t corner = 0; corner < 3 * triangles.size(); ++corner) {
    const auto v = static_cast<std::size_t>(triangles[corner / 3][corner % 3]);
    const auto values = tuple(corner);
    for (std::size_t k = 0; k < N; ++k) mean[k][v] += values[k];
    ++corners[v];
  }
  for (auto& values : mean)
    for (std::size_t v = 0; v < vertices; ++v)
      if (corners[v] > 0) values[v] /= corners[v];
  return mean;
}

}  // namespace pelage
