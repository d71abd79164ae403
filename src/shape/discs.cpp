#include "shape/discs.h"

#include <cmath>
#include <numbers>

#include "shape/cell_voronoi.h"
#include "shape/cloud_points.h"
#include "shape/normals.h"

namespace pelage {

namespace {

constexpr int sides = 6;
/// Of the distance to the sixth nearest point: of points at random a share of exp(-6) of the surface stays open.
constexpr double width = 1;

}  // namespace

TriangleMesh discs_of(const TriangleMesh& cloud) {
  const std::vector<double> reach = distances_to_sixth(cloud.points);
  std::vector<Point> normals = vertex_normals(cloud);
  TriangleMesh discs;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!(length(normals[i]) > 0)) normals[i] = {0, 1, 0};
    const TangentFrame frame(normals[i]);
    const auto first = static_cast<std::int32_t>(discs.points.size());
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides, radius = width * reach[i];
      Point p = frame.out({radius * std::cos(angle), radius * std::sin(angle)});
      for (std::size_t d = 0; d < 3; ++d) p[d] += cloud.points[i][d];
      discs.points.push_back(p);
      if (k >= 2) discs.triangles.push_back({first, first + k - 1, first + k});
    }
  }
  for (const Attribute& given : cloud.attributes) {
    Attribute a = given;
    const auto n = static_cast<std::size_t>(given.components);
    a.values.clear();
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      for (int k = 0; k < sides; ++k)
        a.values.insert(a.values.end(), given.values.begin() + static_cast<std::ptrdiff_t>(n * i),
                        given.values.begin() + static_cast<std::ptrdiff_t>(n * i + n));
    discs.attributes.push_back(std::move(a));
  }
  return discs;
}

}  // namespace pelage
