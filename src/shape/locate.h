#pragma once
// Where points near a triangle mesh lie on it: descents from a known place, and from one mesh to another.

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "shape/mesh_place.h"

namespace pelage {

/// The triangles of a mesh, prepared for local searches; of the topology and the points nothing is kept. All functions
/// can be called from several threads.
class SurfaceWalk {
 public:
  SurfaceWalk(const Topology& topology, const std::vector<Point>& points);
  /// Of triangles that need not fit together, for searches alone.
  SurfaceWalk(const std::vector<Triangle>& triangles, const std::vector<Point>& points);
  ~SurfaceWalk();

  /// From a triangle over edges and vertices to ever nearer ones: the place nearest to p among all triangles around
  /// it. Never leaves the sheet on which it begins but over the rim; ends on boundaries where p lies beyond.
  MeshPlace closest(const Eigen::Vector3d& p, Index from_face) const;
  /// The nearest place on all triangles that do not face away from `normal` (on all triangles when all face away, or
  /// for the normal 0). The first call builds a tree, which takes as long as ten calls of the one below.
  /// `near`: a triangle from which the search is short, or -1; of equally near places it may find another.
  MeshPlace search(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, Index near = -1) const;
  /// The same by looking at every triangle; where several are equally near up to rounding it may find another.
  MeshPlace compare_all(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const;

  Eigen::Vector3d point(const MeshPlace& place) const {
    const Triangle& t = faces_[static_cast<std::size_t>(place.face)].corners;
    return point(t[0]) + place.v * (point(t[1]) - point(t[0])) + place.w * (point(t[2]) - point(t[0]));
  }
  /// Not of unit length.
  Eigen::Vector3d normal(Index face) const;
  std::size_t face_count() const { return faces_.size(); }

 private:
  struct Face {
    Triangle corners;
    std::array<Index, 3> twin;  ///< opposite half-edges
  };
  struct Candidate {
    MeshPlace place;
    double square = std::numeric_limits<double>::infinity();  ///< of the distance
  };
  class Tree;

  const Eigen::Vector3d& point(Index vertex) const { return points_[static_cast<std::size_t>(vertex)]; }
  Candidate nearest_on(Index face, const Eigen::Vector3d& p) const;
  /// The better of `best` and a triangle that does not face away; of equal ones the first.
  Candidate better(Index face, const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const Candidate& best) const;
  Candidate nearest_around(Index corner, const Eigen::Vector3d& p, Candidate best) const;
  Candidate nearest_beyond(const Candidate& from, const Eigen::Vector3d& p) const;

  std::vector<Face> faces_;
  std::vector<Eigen::Vector3d> points_;
  mutable std::once_flag tree_built_;
  mutable std::unique_ptr<Tree> tree_;
};

/// The places on `surface` of all vertices of another triangulation of the same surface: each is sought from the place
/// of a neighbour; where that ends far away or on a sheet that faces away, on the whole surface. Vertices without
/// triangles get face -1 (as do all vertices when `surface` has no triangles).
std::vector<MeshPlace> locate(const Topology& topology, const std::vector<Point>& points, const SurfaceWalk& surface);

}  // namespace pelage
