#pragma once
// The border of a region: its sides in order, and the nodes on them.

#include <array>
#include <string>
#include <vector>

#include "gridgen/region.h"
#include "gridgen/surface_map.h"
#include "pelage/finding.h"

namespace pelage {

/// South and north from west to east, west and east from south to north, meeting in the corners, anticlockwise in the
/// plane. Of a ring south and north alone, both the same way round, with the ring to the left of south.
using Sides = std::array<Curve, 4>;

/// Turns sides so that they meet, and borders that run clockwise, which is noted; cuts an outline. Error(usage),
/// located, for sides without length, sides that do not meet or cut each other, and open rings.
Sides order_sides(const Region& region, std::vector<Finding>& findings);

/// The edges of a volume, turned so that they meet. Error(usage), located, for those that do not, or have no length.
Volume order_edges(const Volume& volume);

/// Whether all sides lie in the plane z = 0.
bool is_flat(const Sides& sides, bool ring);

/// Nodes of the four sides in the order of GridSide: count[0] along south and north, count[1] along west and east,
/// which share the nodes in the corners. Of a ring south and north alone.
struct Border {
  std::array<std::vector<Point>, 4> side;
};

/// Spreads the nodes over the sides by length on the surface, more densely where the region attracts them, with nodes
/// in the corners of the sides. Error(usage), located, for an attraction that is not greater than 0.
Border make_border(const Region& region, const Sides& sides, const std::array<std::int32_t, 2>& count,
                   const SurfaceMap* map);

/// Error(usage), located, where straight edges between so few nodes cut across the border.
void require_enough(const Region& region, const Border& border, const std::array<std::int32_t, 2>& count);

/// "(0.5, -1)", or with z where that is not 0.
std::string place_text(const Point& p);

}  // namespace pelage
