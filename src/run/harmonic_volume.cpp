#include "run/harmonic_volume.h"

#include <algorithm>

#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/locate.h"
#include "shape/tet_mesh.h"
#include "shape/tet_quality.h"

namespace pelage {

namespace {

/// Of the displacements inside, which need not be exact: those of the skin are. The rest is far below what would
/// crush a tetrahedron.
constexpr double tolerance = 1e-5;
/// Of a tetrahedron, as a share of what it had: below that it counts as crushed.
constexpr double least_volume = 0.1;
constexpr int most_rounds = 100;
/// Of all nodes: more is no matter of single places.
constexpr double most_crushed = 0.1;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::vector<char> nodes_of_skin(const TetMesh& volume) {
  std::vector<char> skin(volume.nodes(), 0);
  for (const Triangle& t : mesh_of(volume).triangles)
    for (const Index node : t) skin[at(node)] = 1;
  return skin;
}

std::vector<MeshPlace> nearest_places(const std::vector<Point>& points, const std::vector<char>& wanted,
                                      const TriangleMesh& surface) {
  const SurfaceWalk walk(make_topology(surface.points.size(), surface.triangles), surface.points);
  std::vector<MeshPlace> places(points.size());
  parallel_for(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (wanted[k]) places[k] = walk.search(Eigen::Vector3d::Map(points[k].data()), Eigen::Vector3d::Zero());
  });
  return places;
}

}  // namespace

HarmonicVolume::HarmonicVolume(std::shared_ptr<const TetMesh> volume, std::shared_ptr<const TriangleMesh> surface,
                               SharedMatrix stiffness)
    : volume_(std::move(volume)),
      surface_(std::move(surface)),
      inside_(std::move(stiffness), nodes_of_skin(*volume_)),
      nearest_(nearest_places(volume_->points, inside_.held(), *surface_)) {}

std::vector<Point> HarmonicVolume::points(const std::vector<Point>& surface) const {
  Displacements displacement = displacements(surface);
  spread(displacement);
  std::vector<Point> result(volume_->nodes());
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = moved(k, displacement);
  return result;
}

Point HarmonicVolume::moved(std::size_t node, const Displacements& displacement) const {
  Point p = volume_->points[node];
  for (std::size_t d = 0; d < 3; ++d) p[d] += displacement[node][static_cast<Eigen::Index>(d)];
  return p;
}

HarmonicVolume::Displacements HarmonicVolume::displacements(const std::vector<Point>& surface) const {
  const std::vector<Triangle>& triangles = surface_->triangles;
  Displacements all(volume_->nodes(), Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (inside_.held()[k])
      for (std::size_t d = 0; d < 3; ++d)
        all[k][static_cast<Eigen::Index>(d)] =
            point_at(triangles, surface, nearest_[k])[d] - point_at(triangles, surface_->points, nearest_[k])[d];
  for (Eigen::Index d = 0; d < 3; ++d) {
    Vector along(static_cast<Eigen::Index>(all.size()));
    for (Eigen::Index k = 0; k < along.size(); ++k) along[k] = all[static_cast<std::size_t>(k)][d];
    inside_.complete(along, tolerance);
    for (Eigen::Index k = 0; k < along.size(); ++k) all[static_cast<std::size_t>(k)][d] = along[k];
  }
  return all;
}

/// The nodes of what is crushed take the mean displacement of those around them, and with every round that it stays
/// crushed so do nodes one edge further away: what moves alike keeps its volume.
void HarmonicVolume::spread(Displacements& displacement) const {
  std::vector<int> reach(displacement.size(), 0);  // in edges
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<char> nodes = crushed(displacement);
    if (nodes.empty()) return;
    if (static_cast<double>(std::ranges::count(nodes, 1)) > most_crushed * static_cast<double>(nodes.size())) break;
    for (std::size_t k = 0; k < nodes.size(); ++k) reach[k] += nodes[k];
    for (const Tetrahedron& t : volume_->tets) {
      int most = 0;
      for (const Index node : t) most = std::max(most, reach[at(node)]);
      for (const Index node : t) reach[at(node)] = std::max(reach[at(node)], most - 1);
    }
    displacement = averaged(displacement, reach);
  }
  throw Error(Fault::numerics,
              "the surface moves so far that the inside would be crushed; fair the shape before it is filled");
}

HarmonicVolume::Displacements HarmonicVolume::averaged(const Displacements& displacement,
                                                       const std::vector<int>& reach) const {
  Displacements sum(reach.size(), Eigen::Vector3d::Zero());
  std::vector<int> count(reach.size(), 0);
  for (const Tetrahedron& t : volume_->tets)
    for (const Index to : t)
      if (reach[at(to)] > 0)
        for (const Index from : t) {
          sum[at(to)] += displacement[at(from)];
          ++count[at(to)];
        }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = reach[k] > 0 ? sum[k] / count[k] : displacement[k];
  return sum;
}

std::vector<char> HarmonicVolume::crushed(const Displacements& displacement) const {
  std::vector<char> nodes;
  for (const Tetrahedron& t : volume_->tets) {
    std::array<Point, 4> before, after;
    for (std::size_t c = 0; c < 4; ++c) {
      before[c] = volume_->points[at(t[c])];
      after[c] = moved(at(t[c]), displacement);
    }
    const auto volume = [](const std::array<Point, 4>& p) { return signed_volume(p[0], p[1], p[2], p[3]); };
    if (volume(after) > least_volume * volume(before)) continue;
    nodes.resize(volume_->nodes(), 0);
    for (const Index node : t) nodes[at(node)] = 1;
  }
  return nodes;
}

}  // namespace pelage
