#pragma once
// The surface where a function of space vanishes, as a triangle mesh.

#include <functional>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// A function of space and its gradient at one place; negative inside, positive outside.
struct FieldValue {
  double value = 0;
  Point gradient = {0, 0, 0};
};
using Field = std::function<FieldValue(const Point&)>;

/// The zero level set inside the box, by marching tetrahedra: the box is cut into cubes of side `spacing`, each cube
/// into six tetrahedra around its diagonal (Kuhn's triangulation, which fits across the faces), and every tetrahedron
/// cuts the surface in one triangle or one quadrilateral. Closed, manifold and oriented outward for any function that
/// is positive on the border of the box; details below the spacing are lost and angles are poor (see shape/remesh.h).
TriangleMesh isosurface(const Field& field, const Point& lower, const Point& upper, double spacing);

/// The place on the surface that Newton's method along the gradient reaches from `start`, in steps of at most `reach`
/// (a fraction of the thickness of the solid); the distance left is about 1e-14.
Point project_to_surface(const Field& field, const Point& start, double reach);

}  // namespace pelage
