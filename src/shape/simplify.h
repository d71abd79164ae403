#pragma once
// Fewer triangles where shape and colour change little.

#include <cstddef>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The mesh with at most so many triangles, or as few as it can have: edges are collapsed onto one of their ends, those
/// first that change least of shape and "color" by the quadric of Garland and Heckbert, "Simplifying Surfaces with
/// Color and Texture using Quadric Error Metrics" (1998), in space and encoded colour together. So every vertex is one
/// of the mesh, with its attributes. Open borders keep to themselves; where corners of a vertex differ in an attribute
/// or its faces differ in one, the vertex stays, as do those where a surface is no manifold. The topology does not
/// change and no face turns over. Deterministic; seconds for a million triangles.
TriangleMesh simplify(const TriangleMesh& mesh, std::size_t triangles);

}  // namespace pelage
