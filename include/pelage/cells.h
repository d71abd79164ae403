#pragma once
// Points spread evenly over any polygons or over a cloud of points, each the middle of a cell: Turk 1991, section 4.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

class CoveredParts;

struct Cells {
  /// What the points lie on: triangles that need not fit together, or, without any, a cloud of points with "normal".
  std::shared_ptr<const TriangleMesh> on;
  std::vector<Point> points;   ///< [world units]
  std::vector<Point> normals;  ///< of unit length
  /// The triangle of `on` that a point lies on, or the nearest point of a cloud.
  std::vector<std::int32_t> face;
  std::vector<std::array<double, 2>> place;     ///< at (1-v-w) a + v b + w c of that triangle; empty on clouds
  std::shared_ptr<const CoveredParts> covered;  ///< what of `on` lies inside its other parts, without cells; or null
  double radius = 0;  ///< within which points repel each other: 2 sqrt(area / points) [world units]

  double stretch = 1;  ///< how many times as long as wide cells may become, for diffusion that has directions

  std::size_t nodes() const { return points.size(); }
};

}  // namespace pelage
