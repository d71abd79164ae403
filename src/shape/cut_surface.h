#pragma once
// Surfaces whose triangles were cut, and what there was at their vertices before.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// A place on the way from one vertex to another.
struct CutPlace {
  std::int32_t from, to;
  double part;  ///< of the way, 0 to 1
};

/// Values at such places, one for each.
using LevelFunction = std::function<std::vector<double>(const std::vector<CutPlace>&)>;

/// Where functions with different signs at the ends of edges are 0, or jump over it: by regula falsi with halved
/// weights (Illinois), and in the middle where that keeps one end too long.
std::vector<CutPlace> roots(std::vector<CutPlace> edges, std::vector<double> at_from, std::vector<double> at_to,
                            const LevelFunction& level);

Point on_way(const Point& a, const Point& b, double part);

/// What a surface was cut into.
struct CutSurface {
  std::vector<CutPlace> vertex;  ///< on the surface as it was
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> parent;              ///< of the triangles
  std::vector<std::array<CutPlace, 3>> corners;  ///< of the triangles, between the corners 0, 1, 2 of their parents

  /// What there was at the vertices before (`components` numbers each), at the vertices now.
  std::vector<double> at_vertices(const std::vector<double>& values, std::size_t components = 1) const;
  std::vector<Point> at_vertices(const std::vector<Point>& points) const;
  /// The same of any attribute; names and integers are those of the nearer vertex.
  Attribute of(const Attribute& attribute) const;
};

}  // namespace pelage
