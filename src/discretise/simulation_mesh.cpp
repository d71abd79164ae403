#include "discretise/simulation_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/parallel.h"
#include "discretise/cubic_triangle.h"
#include "pelage/error.h"
#include "shape/refine.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using Eigen::Vector3d;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Vector3d vec(const Point& p) { return Vector3d(p.data()); }

/// Levels are added while their triangles are larger than this many of the mesh to be made: the places on flat
/// triangles then lie on the curved ones almost as evenly.
constexpr double base_edges = 1.5;

double area(const std::vector<Triangle>& triangles, const std::vector<Point>& points) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Point &a = points[at(t[0])], &b = points[at(t[1])], &c = points[at(t[2])];
    sum += length(cross(difference(b, a), difference(c, a))) / 2;
  }
  return sum;
}

/// A few long triangles are no reason to split all: the mesh that is made of them is even all the same.
void refine_for(Hierarchy& levels, std::vector<Point>& control, double edge, std::size_t max_triangles) {
  const double wanted = 4 / std::sqrt(3.0) * area(levels.topology(0).triangles, control) / (edge * edge);
  if (wanted > static_cast<double>(max_triangles))
    throw Error(Fault::input, "a pattern of this size needs " + number(wanted) + " triangles, more than the " +
                                  std::to_string(max_triangles) + " that fit into memory; ask for a larger one");
  for (;;) {
    const std::vector<Triangle>& triangles = levels.topology(levels.finest()).triangles;
    if (static_cast<double>(triangles.size()) >= wanted || prevailing_edge(triangles, control) <= base_edges * edge)
      return;
    levels.refine();
    control = levels.refined(std::move(control), levels.finest() - 1, levels.finest());
  }
}

/// The place on the triangle of which the given one is a quarter; the inverse of Hierarchy's split (a, ab, ca),
/// (ab, b, bc), (ca, bc, c), (bc, ca, ab).
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

/// The limit surface at the vertices of a level.
struct LimitPoints {
  std::vector<Point> position, normal;

  LimitPoints(const LimitMasks& masks, const std::vector<Point>& control)
      : position(combine(masks.position, control)), normal(combine(masks.tangent1, control)) {
    const std::vector<Point> other = combine(masks.tangent2, control);
    for (std::size_t i = 0; i < normal.size(); ++i) normal[i] = unit(cross(normal[i], other[i]));
  }
};

}  // namespace

SimulationMesh::SimulationMesh(Hierarchy& levels, std::vector<Point>& control, const Edge& edge,
                               std::size_t max_triangles) {
  refine_for(levels, control, edge.smallest, max_triangles);
  base_ = levels.shared_topology(0);
  finest_ = levels.shared_topology(levels.finest());
  masks_ = loop_limit_masks(*finest_);
  const std::vector<Point> limit = combine(masks_.position, control);
  IsotropicMesh mesh =
      edge.at_vertices.empty()
          ? isotropic_mesh(finest_->triangles, limit, edge.smallest)
          : isotropic_mesh(finest_->triangles, limit, levels.interpolated(edge.at_vertices, 1, 0, levels.finest()));
  places_ = std::move(mesh.places);
  topology_ = std::make_shared<const Topology>(make_topology(places_.size(), std::move(mesh.triangles)));
  on_shape_ = places_;
  for (MeshPlace& p : on_shape_)
    for (int level = 0; level < levels.finest(); ++level) p = in_parent(p);
}

std::vector<Point> SimulationMesh::points(const std::vector<Point>& control) const {
  const LimitPoints limit(masks_, control);
  std::vector<Point> result(places_.size());
  parallel_for(places_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = finest_->triangles[at(places_[i].face)];
      std::array<Vector3d, 3> corner;
      std::array<std::array<Vector3d, 2>, 3> toward;
      for (std::size_t k = 0; k < 3; ++k) corner[k] = vec(limit.position[at(t[k])]);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d normal = vec(limit.normal[at(t[k])]);
        for (std::size_t side = 0; side < 2; ++side) {
          const Vector3d along = corner[(k + 1 + side) % 3] - corner[k];
          toward[k][side] = along - along.dot(normal) * normal;
        }
      }
      const Vector3d p = cubic_triangle(corner, toward, places_[i].v, places_[i].w);
      result[i] = {p[0], p[1], p[2]};
    }
  });
  return result;
}

std::vector<double> SimulationMesh::values(const std::vector<double>& given, std::size_t components) const {
  std::vector<double> result(places_.size() * components);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto [face, v, w] = on_shape_[i];
    const Triangle& t = base_->triangles[at(face)];
    for (std::size_t c = 0; c < components; ++c)
      result[i * components + c] = (1 - v - w) * given[at(t[0]) * components + c] +
                                   v * given[at(t[1]) * components + c] + w * given[at(t[2]) * components + c];
  }
  return result;
}

Attribute SimulationMesh::values(const Attribute& given) const {
  Attribute result = given;
  const auto n = at(given.components);
  result.domain = Domain::vertex;
  if (given.domain == Domain::vertex) {
    result.values = values(given.values, n);
    return result;
  }
  result.values.resize(places_.size() * n);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto [face, v, w] = on_shape_[i];
    const double* corner = given.values.data() + 3 * at(face) * n;
    for (std::size_t c = 0; c < n; ++c)
      result.values[i * n + c] = (1 - v - w) * corner[c] + v * corner[n + c] + w * corner[2 * n + c];
  }
  return result;
}

namespace {

/// The gradient of one field at every vertex: the mean over the triangles there, by their area.
std::vector<Vector3d> vertex_gradients(const Topology& mesh, const std::vector<Point>& points,
                                       const std::vector<double>& field) {
  std::vector<Vector3d> sum(points.size(), Vector3d::Zero());
  std::vector<double> weight(points.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = vec(points[at(t[0])]), b = vec(points[at(t[1])]), c = vec(points[at(t[2])]);
    const Vector3d n = (b - a).cross(c - a);
    const double twice = n.norm();
    if (!(twice > 0)) continue;
    // Twice the area times the gradient.
    const Vector3d g =
        n.cross(field[at(t[0])] * (c - b) + field[at(t[1])] * (a - c) + field[at(t[2])] * (b - a)) / twice;
    for (const Index v : t) {
      sum[at(v)] += g;
      weight[at(v)] += twice;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (weight[v] > 0) sum[v] /= weight[v];
  return sum;
}

}  // namespace

std::vector<std::vector<double>> fields_at(const std::vector<MeshPlace>& places, const Topology& mesh,
                                           const std::vector<Point>& points,
                                           const std::vector<std::vector<double>>& fields) {
  std::vector<std::vector<double>> result;
  for (const std::vector<double>& field : fields) {
    const std::vector<Vector3d> gradient = vertex_gradients(mesh, points, field);
    std::vector<double>& values = result.emplace_back(places.size());
    parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (places[i].face < 0) continue;
        const Triangle& t = mesh.triangles[at(places[i].face)];
        std::array<double, 3> corner;
        std::array<std::array<double, 2>, 3> toward;
        for (std::size_t k = 0; k < 3; ++k) {
          corner[k] = field[at(t[k])];
          for (std::size_t side = 0; side < 2; ++side)
            toward[k][side] = gradient[at(t[k])].dot(vec(points[at(t[(k + 1 + side) % 3])]) - vec(points[at(t[k])]));
        }
        values[i] = cubic_triangle(corner, toward, places[i].v, places[i].w);
      }
    });
  }
  return result;
}

}  // namespace pelage
