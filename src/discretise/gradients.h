#pragma once
// Scalar products of the surface gradients of functions, from the elements' own derivatives.

#include <array>
#include <memory>
#include <vector>

#include "discretise/discretisation.h"
#include "discretise/metric.h"

namespace pelage {

/// The geometry of a surface where gradients are asked for, made once and used for every product.
class Gradients {
 public:
  /// Keeps a reference to the discretisation. `pattern`: of its mass matrix.
  Gradients(const Discretisation& discretisation, const std::vector<Point>& control,
            const std::shared_ptr<const SparsePattern>& pattern);

  /// grad u . grad v of functions with these coefficients, at the quadrature points [1 / world^2].
  Vector at_quadrature_points(const Vector& u, const Vector& v) const;
  /// The same at the vertices: of functions that are smooth there the value; of linear elements that of the means of
  /// the gradients around, weighted with the areas. (The mean of the products would be exact for the function that
  /// there is, but not 0 at its peaks, which then run away where a rate contains |grad u|^2: a peak of height d between
  /// neighbours grows with d^2 and is smoothed with d. The gradient of the mean is 0 there.)
  Vector at_vertices(const Vector& u, const Vector& v) const;

 private:
  const Discretisation& d_;
  std::vector<Form> at_points_, at_vertices_;  ///< G^-1; 0 where the surface degenerates
  std::array<SparseMatrix, 3> mean_;           ///< of nodal methods: the mean gradient around each vertex
};

}  // namespace pelage
