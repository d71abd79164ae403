#pragma once
// Normals of flat triangles.

#include <cstdint>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// At every vertex the area-weighted mean of the normals of its triangles, of unit length; 0 where there are none.
std::vector<Point> vertex_normals(const std::vector<Triangle>& triangles, const std::vector<Point>& points);

/// The same of a mesh; without triangles the attribute "normal", or 0.
std::vector<Point> vertex_normals(const TriangleMesh& mesh);

/// The attribute "normal" of the vertices, of unit length; where there is none, the normals of the triangles.
std::vector<Point> normals_of(const TriangleMesh& mesh);

/// "normal" at the corners of triangles: smooth, but where two meet at more than 40 degrees or are of different sides
/// (a number per triangle; of one side without).
Attribute corner_normals(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                         std::span<const std::uint8_t> side = {});

}  // namespace pelage
