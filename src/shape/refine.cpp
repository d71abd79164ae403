#include "shape/refine.h"

#include <algorithm>
#include <cmath>

#include "pelage/error.h"

namespace pelage {

namespace {

struct TriangleSize {
  double edge, area;
};

TriangleSize measure(const Triangle& t, const std::vector<Point>& points) {
  std::array<double, 3> square{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point& a = points[static_cast<std::size_t>(t[k])];
    const Point& b = points[static_cast<std::size_t>(t[(k + 1) % 3])];
    for (std::size_t d = 0; d < 3; ++d) square[k] += (b[d] - a[d]) * (b[d] - a[d]);
  }
  const auto [x, y, z] = square;
  const double heron = 2 * (x * y + y * z + z * x) - (x * x + y * y + z * z);  // 16 area^2
  return {std::sqrt(std::max({x, y, z})), std::sqrt(std::max(0.0, heron)) / 4};
}

/// Corner values of the four children of every triangle: corners keep theirs, midpoints get the mean.
std::vector<double> split_corner_values(const std::vector<double>& values, std::size_t components) {
  std::vector<double> fine;
  fine.reserve(4 * values.size());
  std::vector<double> middle(3 * components);
  for (std::size_t base = 0; base < values.size(); base += 3 * components) {
    const double* corner = values.data() + base;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < components; ++c)
        middle[k * components + c] = (corner[k * components + c] + corner[(k + 1) % 3 * components + c]) / 2;
    const double *a = corner, *b = a + components, *c = b + components;
    const double *ab = middle.data(), *bc = ab + components, *ca = bc + components;
    for (const double* v : {a, ab, ca, ab, b, bc, ca, bc, c, bc, ca, ab}) fine.insert(fine.end(), v, v + components);
  }
  return fine;
}

}  // namespace

double prevailing_edge(const std::vector<Triangle>& triangles, const std::vector<Point>& points) {
  std::vector<TriangleSize> sizes;
  sizes.reserve(triangles.size());
  double total = 0;
  for (const Triangle& t : triangles) {
    sizes.push_back(measure(t, points));
    total += sizes.back().area;
  }
  std::sort(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.edge > b.edge; });
  double beyond = 0;
  for (const TriangleSize& s : sizes) {
    beyond += s.area;
    if (beyond >= 0.05 * total) return s.edge;
  }
  return 0;
}

RefinedMesh refine_once(const RefinedMesh& mesh, bool loop) {
  const Refinement fine = loop ? loop_refine(mesh.topology) : midpoint_refine(mesh.topology);
  return {make_topology(fine.stencils.rows(), fine.triangles), combine(fine.stencils, mesh.control), mesh.levels + 1};
}

RefinedMesh refine_to_edge(RefinedMesh mesh, double edge, bool loop, std::size_t max_triangles) {
  while (prevailing_edge(mesh.topology.triangles, mesh.control) > edge) {
    if (4 * mesh.topology.triangles.size() > max_triangles)
      throw Error(Fault::input, "the pattern is too fine for this shape: it needs more than " +
                                    std::to_string(max_triangles) + " triangles; ask for a larger --size");
    mesh = refine_once(mesh, loop);
  }
  return mesh;
}

void refine_attribute(Attribute& attribute, const Refinement& midpoints) {
  const auto components = static_cast<std::size_t>(attribute.components);
  attribute.values = attribute.domain == Domain::vertex ? combine(midpoints.stencils, attribute.values, components)
                                                        : split_corner_values(attribute.values, components);
}

TriangleMesh split_at_midpoints(const TriangleMesh& mesh) {
  const Refinement fine = midpoint_refine(make_topology(mesh.points.size(), mesh.triangles));
  TriangleMesh result{combine(fine.stencils, mesh.points), fine.triangles, mesh.attributes};
  for (Attribute& a : result.attributes) refine_attribute(a, fine);
  return result;
}

}  // namespace pelage
