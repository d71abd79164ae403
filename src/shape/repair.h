#pragma once
// The gate of the program: what passes here is a surface that everything behind can work with.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/finding.h"

namespace pelage {

/// Checks a mesh and repairs what is safe. What comes back
///   has finite coordinates and attribute values, and every vertex is used;
///   is manifold: at an edge one or two triangles meet, around a vertex they form one fan;
///   is oriented: neighbours agree, closed components enclose a positive volume.
/// Parts named by the face attribute "object" stay parts where they touch, unless they are pieces of one closed
/// surface. Removed: triangles with two corners in one place, copies of triangles, unused vertices. Merged: vertices in
/// exactly the same place along open edges that fit together. Separated: sheets that touch only in a vertex, or
/// solids that touch in an edge. Only reported: triangles without area. The order of what remains is kept;
/// attributes follow (what differs along a merged seam moves to the corners).
/// Appends what was found; every repair is reported. `source_face[t]` is the number that triangle t has in the
/// messages (empty: t).
/// Throws ShapeFault: no triangles, vertex numbers out of range, a used vertex that is not finite or beyond
/// 1e75, no extent (below 1e-75), an edge with three or more faces, a one-sided surface.
TriangleMesh repair(TriangleMesh mesh, std::vector<Finding>& findings,
                    const std::vector<std::int32_t>& source_face = {});

/// Sets values that are not finite to 0; the part of a repair that concerns attributes alone.
void clear_non_finite_attributes(std::vector<Attribute>& attributes, std::vector<Finding>& findings);

}  // namespace pelage
