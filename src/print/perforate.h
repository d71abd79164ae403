#pragma once
// Surfaces with holes where a function is above 0.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// A place on the way from one vertex to another.
struct CutPlace {
  std::int32_t from, to;
  double part;  ///< of the way, 0 to 1
};

/// Values at such places, one for each; above 0 there is nothing.
using LevelFunction = std::function<std::vector<double>(const std::vector<CutPlace>&)>;

/// What is left of a surface.
struct PerforatedSurface {
  std::vector<CutPlace> vertex;  ///< on the surface as it was
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> parent;              ///< of the triangles
  std::vector<std::array<CutPlace, 3>> corners;  ///< of the triangles, between the corners 0, 1, 2 of their parents
  std::size_t islands = 0;                       ///< parts that hung on nothing and were left out
  double island_area = 0, area = 0;              ///< theirs, and of what is left [world units^2]

  /// What there was at the vertices before (`components` numbers each), at the vertices now.
  std::vector<double> at_vertices(const std::vector<double>& values, std::size_t components = 1) const;
  std::vector<Point> at_vertices(const std::vector<Point>& points) const;
  /// The same of any attribute; names and integers are those of the nearer vertex.
  Attribute of(const Attribute& attribute) const;
};

/// Cuts a manifold surface where the level function is 0, which is found along every edge with a change of sign; the
/// line between is straight on each triangle. Vertices that lie next to it move onto it, but for those on creases and
/// borders, from which it keeps a twentieth of the edge: so no triangle is a sliver. What is left is manifold: where
/// two holes would touch in a vertex they end before. Of every connected part of the surface the largest piece is kept.
/// Without triangles where nothing is left; as it was where there is no hole.
PerforatedSurface perforated(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                             const LevelFunction& level);

}  // namespace pelage
