#pragma once
// Where a surface goes through itself.

#include <cstdint>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Two triangles that meet, the one with the smaller number first.
struct Meeting {
  std::int32_t first, second;
  bool operator==(const Meeting&) const = default;
};

/// All pairs of triangles that have a point in common beside the vertices and edges that they share, touching included;
/// in order. Decided exactly for the coordinates as they are; triangles without area meet nothing. `asked`, if not
/// empty, marks triangles: only pairs with one of them are looked at.
std::vector<Meeting> self_meetings(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                                   std::span<const char> asked = {});

/// Whether two triangles of a mesh meet so.
bool meet(const Triangle& s, const Triangle& t, const std::vector<Point>& points);

/// The middle of a triangle.
Point middle_of(const Triangle& t, const std::vector<Point>& points);

}  // namespace pelage
