#include "fair/compare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/quantile.h"
#include "fair/faces.h"
#include "fair/volume.h"
#include "pelage/error.h"
#include "shape/closest_point.h"

namespace pelage {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double sharp_edge = 35 / degrees;

std::vector<char> faces_at_sharp_edges(const Topology& topology, const std::vector<Vector3>& normal) {
  std::vector<char> sharp_vertex(topology.vertex_count, 0), sharp(topology.triangles.size(), 0);
  for (Index h = 0; h < static_cast<Index>(topology.twin.size()); ++h)
    if (topology.twin[h] > h && normal[h / 3].dot(normal[topology.twin[h] / 3]) < std::cos(sharp_edge))
      sharp_vertex[topology.origin(h)] = sharp_vertex[topology.target(h)] = 1;
  for (std::size_t f = 0; f < sharp.size(); ++f)
    for (Index v : topology.triangles[f]) sharp[f] = static_cast<char>(sharp[f] | sharp_vertex[v]);
  return sharp;
}

NormalErrors normal_errors(const TriangleMesh& mesh, const TriangleMesh& reference) {
  const std::vector<Vector3> normal = face_geometry(mesh.triangles, mesh.points).normal;
  const std::vector<Vector3> truth = face_geometry(reference.triangles, reference.points).normal;
  const std::vector<char> sharp =
      faces_at_sharp_edges(make_topology(reference.points.size(), reference.triangles), truth);
  std::vector<double> angle(normal.size());
  NormalErrors errors;
  std::size_t sharp_count = 0;
  for (std::size_t f = 0; f < normal.size(); ++f) {
    angle[f] = std::acos(std::clamp(normal[f].dot(truth[f]), -1.0, 1.0)) * degrees;
    errors.mean += angle[f] / static_cast<double>(normal.size());
    errors.flipped += angle[f] > 90;
    if (sharp[f]) {
      errors.sharp += angle[f];
      ++sharp_count;
    }
  }
  if (sharp_count) errors.sharp /= static_cast<double>(sharp_count);
  errors.quantile95 = quantile(angle, 0.95);
  return errors;
}

double diagonal(const TriangleMesh& mesh) {
  Eigen::Array3d low = vector3(mesh.points[mesh.triangles[0][0]]), high = low;
  for (const Triangle& t : mesh.triangles)
    for (std::int32_t v : t) {
      low = low.min(vector3(mesh.points[v]).array());
      high = high.max(vector3(mesh.points[v]).array());
    }
  return (high - low).matrix().norm();
}

/// Weighted with the areas of the triangles at each vertex.
void measure_distances(const TriangleMesh& mesh, const TriangleMesh& reference, Comparison& result) {
  const DistanceTree tree(reference);
  std::vector<double> distance(mesh.points.size()), weight(mesh.points.size(), 0.0);
  parallel_for(
      distance.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) distance[v] = tree.distance(mesh.points[v]);
      },
      256);
  const std::vector<double> area = face_geometry(mesh.triangles, mesh.points).area;
  for (std::size_t f = 0; f < area.size(); ++f)
    for (std::int32_t v : mesh.triangles[f]) weight[v] += area[f];
  double sum = 0, total = 0;
  for (std::size_t v = 0; v < distance.size(); ++v) {
    sum += weight[v] * distance[v] * distance[v];
    total += weight[v];
    if (weight[v] > 0) result.largest_distance = std::max(result.largest_distance, distance[v]);
  }
  result.distance = total > 0 ? std::sqrt(sum / total) : 0;
}

double volume(const TriangleMesh& mesh) {
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  return ClosedParts(topology).volume(mesh.points);
}

}  // namespace

Comparison compare(const TriangleMesh& mesh, const TriangleMesh& reference) {
  if (mesh.triangles.empty() || reference.triangles.empty())
    throw Error(Fault::input, "a mesh without triangles cannot be compared");
  const double size = diagonal(reference);
  if (!(size > 0)) throw Error(Fault::input, "the reference has no extent");
  Comparison result;
  if (mesh.triangles == reference.triangles) result.normals = normal_errors(mesh, reference);
  measure_distances(mesh, reference, result);
  result.distance /= size;
  result.largest_distance /= size;
  const double before = volume(reference);
  if (before != 0) result.volume_change = volume(mesh) / before - 1;
  return result;
}

}  // namespace pelage
