#pragma once
// Normals of flat triangles and of limit surfaces.

#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/loop_subdivision.h"

namespace pelage {

/// At every vertex the area-weighted mean of the normals of its triangles, of unit length; 0 where there are none.
std::vector<Point> vertex_normals(const std::vector<Triangle>& triangles, const std::vector<Point>& points);

/// Of the limit surface of control points at their vertices, of unit length; 0 where it degenerates.
std::vector<Point> limit_normals(const LimitMasks& masks, const std::vector<Point>& control);

}  // namespace pelage
