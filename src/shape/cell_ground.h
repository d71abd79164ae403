#pragma once
// What cells lie on: places are scattered over it, and move along it.

#include <cstdint>
#include <memory>

#include "base/box.h"
#include "pelage/triangle_mesh.h"
#include "shape/covered_parts.h"

namespace pelage {

/// A place on its way.
struct CellPlace {
  Point point, normal;
  std::int32_t face = 0;          ///< a triangle, or the nearest point of a cloud
  std::array<double, 2> place{};  ///< in that triangle
};

/// All functions can be called from several threads.
class CellGround {
 public:
  virtual ~CellGround() = default;
  virtual double area() const = 0;
  virtual Box box() const = 0;
  /// Points of a cloud that do not count since they are far from all others.
  virtual std::size_t outliers() const { return 0; }
  /// How many points of a cloud count; 0 for polygons.
  virtual std::size_t points_that_count() const { return 0; }
  /// What lies inside other parts and is no ground; null: nothing.
  virtual std::shared_ptr<const CoveredParts> covered() const { return nullptr; }
  /// The k-th of n places spread evenly at random.
  virtual CellPlace scattered(std::size_t k, std::size_t n) const = 0;
  /// By a tangential step, which turns with the ground.
  virtual void move(CellPlace& place, const Point& step) const = 0;
};

/// Triangles that need not fit together. Error(Fault::input) where they have no area.
std::unique_ptr<const CellGround> polygon_ground(std::shared_ptr<const TriangleMesh> mesh);
/// Points without triangles; their normals are those of the attribute "normal", or estimated. Error(Fault::input) where
/// they are too few, or lie in no surface.
std::unique_ptr<const CellGround> cloud_ground(std::shared_ptr<const TriangleMesh> mesh);

/// The number of the part in which a share of the whole lies; `sums`: of the parts up to each.
std::size_t part_at(const std::vector<double>& sums, double share);

}  // namespace pelage
