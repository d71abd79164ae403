#pragma once
// Isotropic remeshing: triangles of nearly equal edges on the same closed surface.

#include <functional>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// A mesh of the same surface with about `vertices` vertices of equal spacing, mostly of valence 5 to 7: rounds of
/// edge splits, collapses, flips and tangential relaxation (Botsch, Kobbelt 2004, "A remeshing approach to
/// multiresolution modeling", section 4). `project` brings a point near the surface onto it; it is called from
/// several threads. Needs a closed manifold mesh; attributes are dropped.
TriangleMesh remesh(const TriangleMesh& mesh, std::size_t vertices, const std::function<Point(const Point&)>& project);

}  // namespace pelage
