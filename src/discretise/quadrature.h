#pragma once
// Places, functions and their gradients at the quadrature points of a discretisation.

#include <vector>

#include "discretise/discretisation.h"
#include "pelage/point.h"

namespace pelage {

/// Positions on the surface and area weights (their sum is the area) of all quadrature points.
struct QuadratureGeometry {
  std::vector<Point> position, normal;
  std::vector<double> weight;
};
QuadratureGeometry quadrature_geometry(const Discretisation& discretisation, const std::vector<Point>& control);

/// Surface gradients of a function at the quadrature points, as vectors in space.
std::vector<Point> quadrature_gradients(const Discretisation& discretisation, const std::vector<Point>& control,
                                        const Vector& coefficients);

/// Quadrature points x unknowns: the values of the basis functions there.
SparseMatrix quadrature_values(const Discretisation& discretisation);

}  // namespace pelage
