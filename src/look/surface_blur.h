#pragma once
// Values at the vertices of a mesh, blurred on its surface: what flows by du/dt = Laplacian u for a time t is blurred
// by a Gaussian of the variance 2 t (Turk 1991 makes the coarser levels of a texture so). Nothing crosses from one
// sheet to another, however near they are in space or in an image, and the mean stays what it was.

#include <memory>

#include "linalg/conjugate_gradient.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

class SurfaceBlur {
 public:
  /// Of a manifold mesh: the errors of make_topology.
  SurfaceBlur(const std::vector<Triangle>& triangles, std::vector<Point> points);

  /// Blurs each of the values, one per vertex, by so much more [length^2]: to 1 % of what is left of them, where that
  /// is three quarters of all. By two steps of Alexander's (1977) L-stable method of second order, whose solves are by
  /// conjugate gradients; Error(Fault::numerics) where these fail.
  void blur(std::vector<Vector>& values, double variance) const;
  /// Over the surface.
  double mean(const Vector& values) const;

 private:
  SharedMatrix mass_, stiffness_;
};

}  // namespace pelage
