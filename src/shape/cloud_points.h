#pragma once
// A cloud of points as a surface: neighbours, normals and areas of its points.

#include <cstdint>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The points that count: without copies, without those much nearer to another than others are, and without outliers,
/// which are far from all others.
struct CloudPoints {
  static constexpr std::size_t nearest = 16;

  std::vector<Point> point, normal;  ///< [world units], of unit length
  std::vector<double> area;          ///< of the points' own parts of the surface
  std::vector<double> reach;         ///< the distance to the last of the nearest ones
  std::vector<std::int32_t> number;  ///< in the mesh
  std::vector<std::int32_t> kept;    ///< per point of the mesh: which of these it is, or -1
  std::vector<std::int32_t> near;    ///< `nearest` of each, in order of their distance
  std::size_t outliers = 0;

  std::span<const std::int32_t> neighbours(std::size_t i) const { return {near.data() + nearest * i, nearest}; }
};

/// Normals are those of the attribute "normal" of 3 components per vertex; where it is missing, or 0 or not finite for
/// some, those of the planes of their neighbours, turned alike from neighbour to neighbour, the highest point of every
/// part upwards. Error(Fault::input) where fewer than 2 * nearest points are left, or
/// where most of them lie along lines.
CloudPoints cloud_points(const TriangleMesh& mesh);

/// Per point of a cloud; no more than half as much again as it is for most.
std::vector<double> distances_to_sixth(const std::vector<Point>& points);

}  // namespace pelage
