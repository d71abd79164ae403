#pragma once
// Surfaces with a height above them.

#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// At every vertex the gradient, along the surface, of a function that is linear on the triangles: the area-weighted
/// mean of theirs. `values`: one per vertex.
std::vector<Point> surface_gradients(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                                     const std::vector<double>& values);

/// Normals of what stands `height` above a surface with these unit normals: n - grad h, as if it were flat.
std::vector<Point> relief_normals(const TriangleMesh& mesh, const std::vector<Point>& normals,
                                  const std::vector<double>& height);

/// The mesh with every vertex moved along its "normal" by `height`, and the normals of the moved surface.
TriangleMesh raised(TriangleMesh mesh, const std::vector<double>& height);

}  // namespace pelage
