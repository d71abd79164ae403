#include "shape/refine.h"

#include <algorithm>
#include <cmath>

#include "shape/loop_subdivision.h"

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

std::vector<double> split_face_values(const std::vector<double>& values, std::size_t components) {
  std::vector<double> fine;
  fine.reserve(4 * values.size());
  for (auto face = values.begin(); face != values.end(); face += static_cast<std::ptrdiff_t>(components))
    for (int child = 0; child < 4; ++child)
      fine.insert(fine.end(), face, face + static_cast<std::ptrdiff_t>(components));
  return fine;
}

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Calls set(vertex, a, b) for every vertex of the fine mesh, which lies in the middle between a and b of the coarse
/// one; these are the same where it is one of them.
template <class Set>
void for_each_split_vertex(const Topology& t, Set&& set) {
  for (Index v = 0; v < t.vertex_count; ++v) set(at(v), at(v), at(v));
  for (std::size_t h = 0; h < t.twin.size(); ++h) {
    const auto halfedge = static_cast<Index>(h);
    if (t.twin[h] >= 0 && t.twin[h] < halfedge) continue;
    set(at(t.vertex_count) + at(t.edge[h]), at(t.origin(halfedge)), at(t.target(halfedge)));
  }
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

MeshPlace in_child(const MeshPlace& p) {
  const auto [face, v, w] = p;
  if (v + w <= 0.5) return {4 * face, 2 * v, 2 * w};
  if (v >= 0.5) return {4 * face + 1, 2 * v - 1, 2 * w};
  if (w >= 0.5) return {4 * face + 2, 2 * v, 2 * w - 1};
  return {4 * face + 3, 1 - 2 * v, 1 - 2 * w};
}

MeshPlace in_parent(const MeshPlace& p) {
  const Index parent = p.face / 4;
  switch (p.face % 4) {
    case 0:
      return {parent, p.v / 2, p.w / 2};
    case 1:
      return {parent, (1 + p.v) / 2, p.w / 2};
    case 2:
      return {parent, p.v / 2, (1 + p.w) / 2};
    default:
      return {parent, (1 - p.v) / 2, (1 - p.w) / 2};
  }
}

// 0.0 + takes the sign off zeros.

std::vector<double> split_values(const Topology& coarse, const std::vector<double>& values, std::size_t components) {
  std::vector<double> fine((static_cast<std::size_t>(coarse.vertex_count) + at(coarse.edge_count)) * components);
  const auto set = [&](std::size_t vertex, std::size_t a, std::size_t b) {
    for (std::size_t c = 0; c < components; ++c)
      fine[vertex * components + c] = 0.0 + 0.5 * values[a * components + c] + 0.5 * values[b * components + c];
  };
  for_each_split_vertex(coarse, set);
  return fine;
}

std::vector<Point> split_points(const Topology& coarse, const std::vector<Point>& points) {
  std::vector<Point> fine(at(coarse.vertex_count) + at(coarse.edge_count));
  const auto set = [&](std::size_t vertex, std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < 3; ++k) fine[vertex][k] = 0.0 + 0.5 * points[a][k] + 0.5 * points[b][k];
  };
  for_each_split_vertex(coarse, set);
  return fine;
}

void split_attribute(const Topology& coarse, Attribute& attribute) {
  const auto components = static_cast<std::size_t>(attribute.components);
  switch (attribute.domain) {
    case Domain::vertex:
      attribute.values = split_values(coarse, attribute.values, components);
      break;
    case Domain::corner:
      attribute.values = split_corner_values(attribute.values, components);
      break;
    case Domain::face:
      attribute.values = split_face_values(attribute.values, components);
      break;
  }
  widen(attribute);
}

TriangleMesh split_at_midpoints(const TriangleMesh& mesh) {
  const Topology coarse = make_topology(mesh.points.size(), mesh.triangles);
  TriangleMesh result{split_points(coarse, mesh.points), split_triangles(coarse), mesh.attributes, mesh.links,
                      mesh.metres_per_unit};
  for (Attribute& a : result.attributes) split_attribute(coarse, a);
  return result;
}

}  // namespace pelage
