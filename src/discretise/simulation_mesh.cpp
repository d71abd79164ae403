#include "discretise/simulation_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/number.h"
#include "base/parallel.h"
#include "base/report.h"
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
void refine_for(Hierarchy& levels, std::vector<Point>& control, double edge, std::size_t max_triangles,
                const Progress& progress) {
  const double wanted = 4 / std::sqrt(3.0) * area(levels.topology(0).triangles, control) / (edge * edge);
  if (wanted > static_cast<double>(max_triangles))
    throw Error(Fault::input, "a pattern of this size needs " + number(wanted) + " triangles, more than the " +
                                  std::to_string(max_triangles) + " that fit into memory; ask for a larger one");
  for (;;) {
    report(progress, "meshing", 0);
    const std::vector<Triangle>& triangles = levels.topology(levels.finest()).triangles;
    if (static_cast<double>(triangles.size()) >= wanted || prevailing_edge(triangles, control) <= base_edges * edge)
      return;
    levels.refine();
    control = levels.refined(std::move(control), levels.finest() - 1, levels.finest());
  }
}

}  // namespace

Point smooth_point(const std::array<Point, 3>& corners, const std::array<Point, 3>& normals, double v, double w) {
  std::array<Vector3d, 3> corner;
  std::array<std::array<Vector3d, 2>, 3> toward;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = vec(corners[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d normal = vec(normals[k]);
    for (std::size_t side = 0; side < 2; ++side) {
      const Vector3d along = corner[(k + 1 + side) % 3] - corner[k];
      toward[k][side] = along - along.dot(normal) * normal;
    }
  }
  const Vector3d p = cubic_triangle(corner, toward, v, w);
  return {p[0], p[1], p[2]};
}

SimulationMesh::SimulationMesh(Hierarchy& levels, std::vector<Point>& control, const Edge& edge,
                               std::size_t max_triangles, const Progress& progress) {
  refine_for(levels, control, edge.smallest, max_triangles, progress);
  base_ = levels.shared_topology(0);
  finest_ = levels.shared_topology(levels.finest());
  const std::vector<Point> limit = loop_limits(*finest_, control);
  std::vector<double> edges(limit.size(), edge.smallest);
  if (!edge.at_vertices.empty()) edges = levels.interpolated(edge.at_vertices, 1, 0, levels.finest());
  IsotropicMesh mesh = isotropic_mesh(levels, limit, std::move(edges), progress);
  places_ = std::move(mesh.places);
  topology_ = std::make_shared<const Topology>(std::move(mesh.topology));
  levels_ = levels.finest();
}

std::vector<Point> SimulationMesh::points(const std::vector<Point>& control) const {
  const std::vector<Point> limit = loop_limits(*finest_, control);
  const CornerNormals normals(*finest_, control);
  std::vector<Point> result(places_.size());
  parallel_for(places_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t face = at(places_[i].face);
      const auto [a, b, c] = finest_->triangles[face];
      result[i] =
          smooth_point({limit[at(a)], limit[at(b)], limit[at(c)]},
                       {normals.at(face, 0), normals.at(face, 1), normals.at(face, 2)}, places_[i].v, places_[i].w);
    }
  });
  return result;
}

namespace {

/// Of tuples of `n` numbers, linear between those that tuple(face, k) names at the three corners of the shape's faces.
template <class Tuple>
std::vector<double> linear(const std::vector<MeshPlace>& places, int levels, const std::vector<double>& given,
                           std::size_t n, Tuple&& tuple) {
  std::vector<double> result(places.size() * n);
  parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      MeshPlace place = places[i];
      for (int level = 0; level < levels; ++level) place = in_parent(place);
      const auto [face, v, w] = place;
      const std::size_t a = n * tuple(at(face), 0), b = n * tuple(at(face), 1), c = n * tuple(at(face), 2);
      for (std::size_t k = 0; k < n; ++k)
        result[i * n + k] = (1 - v - w) * given[a + k] + v * given[b + k] + w * given[c + k];
    }
  });
  return result;
}

}  // namespace

std::vector<double> SimulationMesh::values(const std::vector<double>& given, std::size_t components) const {
  return linear(places_, levels_, given, components,
                [&](std::size_t face, std::size_t k) { return at(base_->triangles[face][k]); });
}

Attribute SimulationMesh::values(const Attribute& given) const {
  Attribute result = given;
  const auto n = at(given.components);
  result.domain = Domain::vertex;
  if (given.domain == Domain::vertex)
    result.values = values(given.values, n);
  else
    result.values = linear(places_, levels_, given.values, n, [&](std::size_t face, std::size_t k) {
      return given.domain == Domain::face ? face : 3 * face + k;
    });
  widen(result);
  return result;
}

namespace {

/// The gradient of one field at every vertex: the mean over the triangles there, by their area.
std::vector<Point> vertex_gradients(const CutMesh& mesh, const std::vector<Point>& points,
                                    const std::vector<double>& field) {
  std::vector<Vector3d> sum(mesh.vertex.size(), Vector3d::Zero());
  std::vector<double> weight(mesh.vertex.size(), 0.0);
  for (const Triangle& cut : mesh.triangles) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = mesh.vertex[at(cut[k])];
    const Vector3d a = vec(points[at(t[0])]), b = vec(points[at(t[1])]), c = vec(points[at(t[2])]);
    const Vector3d n = (b - a).cross(c - a);
    const double twice = n.norm();
    if (!(twice > 0)) continue;
    // Twice the area times the gradient.
    const Vector3d g =
        n.cross(field[at(t[0])] * (c - b) + field[at(t[1])] * (a - c) + field[at(t[2])] * (b - a)) / twice;
    for (const Index v : cut) {
      sum[at(v)] += g;
      weight[at(v)] += twice;
    }
  }
  std::vector<Point> mean(sum.size());
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (weight[v] > 0) sum[v] /= weight[v];
    mean[v] = {sum[v][0], sum[v][1], sum[v][2]};
  }
  return mean;
}

std::vector<Index> all_vertices(std::size_t count) {
  std::vector<Index> vertices(count);
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

}  // namespace

MeshFields::MeshFields(CutMesh cut, const std::vector<Point>& points, const std::vector<std::vector<double>>& fields)
    : mesh_(std::move(cut)), points_(points), fields_(fields) {
  for (const std::vector<double>& field : fields) gradients_.push_back(vertex_gradients(mesh_, points, field));
}

MeshFields::MeshFields(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                       const std::vector<std::vector<double>>& fields)
    : MeshFields(CutMesh{triangles, all_vertices(points.size())}, points, fields) {}

MeshFields::MeshFields(const Topology& mesh, const std::vector<Point>& points,
                       const std::vector<std::vector<double>>& fields)
    : MeshFields(cut_at_creases(mesh), points, fields) {}

double MeshFields::at(std::size_t field, const MeshPlace& place) const {
  const Triangle& cut = mesh_.triangles[pelage::at(place.face)];
  const auto of = [&](const auto& values, std::size_t k) -> const auto& {
    return values[pelage::at(mesh_.vertex[pelage::at(cut[k % 3])])];
  };
  std::array<double, 3> corner;
  std::array<std::array<double, 2>, 3> toward;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = of(fields_[field], k);
    for (std::size_t side = 0; side < 2; ++side)
      toward[k][side] =
          vec(gradients_[field][pelage::at(cut[k])]).dot(vec(of(points_, k + 1 + side)) - vec(of(points_, k)));
  }
  return cubic_triangle(corner, toward, place.v, place.w);
}

std::vector<std::vector<double>> fields_at(const std::vector<MeshPlace>& places, const Topology& mesh,
                                           const std::vector<Point>& points,
                                           const std::vector<std::vector<double>>& fields) {
  const MeshFields anywhere(mesh, points, fields);
  std::vector<std::vector<double>> result(fields.size(), std::vector<double>(places.size()));
  for (std::size_t f = 0; f < fields.size(); ++f)
    parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (places[i].face >= 0) result[f][i] = anywhere.at(f, places[i]);
    });
  return result;
}

}  // namespace pelage
