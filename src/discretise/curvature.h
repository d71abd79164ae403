#pragma once
// Curvature of the surface: of the limit surface for Loop elements, of the flat triangles' turning normals for linear
// ones. Units: 1 / world unit. Positive where the surface bends away from its normal: 1 / r on a sphere of radius r.

#include "discretise/assembly.h"
#include "discretise/quadrature.h"

namespace pelage {

/// The shape operator at every quadrature point as a tensor in space: k1 e1 e1' + k2 e2 e2' with the principal
/// curvatures and directions; 0 where the surface degenerates. At an extraordinary vertex the curvature of a Loop
/// surface is 0 or unbounded (Reif 1995), but no quadrature point lies there.
std::vector<Tensor> quadrature_curvature(const Discretisation& discretisation, const std::vector<Point>& control);

/// The mean over the triangles around each vertex, weighted with area.
std::vector<Tensor> vertex_curvature(const Discretisation& discretisation, const std::vector<Point>& control);

struct PrincipalCurvatures {
  std::vector<double> k1, k2;  ///< k1 >= k2
};

/// Of the tensors' parts perpendicular to the normals.
PrincipalCurvatures principal_curvatures(const std::vector<Tensor>& curvature, const std::vector<Point>& normal);

}  // namespace pelage
