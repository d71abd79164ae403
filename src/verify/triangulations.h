#pragma once
// One shape, several triangulations: what is grown must not depend on which.

#include "pelage/triangle_mesh.h"

namespace pelage {

enum class SphereTriangulation {
  uniform,  ///< nearly equal, nearly equilateral
  graded,   ///< edges ten times longer at one pole than at the other, angles unchanged
  slivers   ///< one vertex in five moved until its nearest edge is a twelfth: needles of about 5 degrees
};

/// The unit sphere with about n vertices, all exactly on it; closed, oriented outward.
TriangleMesh unit_sphere(SphereTriangulation triangulation, int n);

}  // namespace pelage
