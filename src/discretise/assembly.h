#pragma once
// Mass, stiffness and load for any discretisation: M = B' W B, K(D) = G' W D G, load = B' W f, with B the basis
// functions and G their surface gradients at the quadrature points and W the quadrature weights times the area element.

#include <vector>

#include "discretise/discretisation.h"
#include "discretise/element_matrices.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// A symmetric tensor in world coordinates: xx, xy, xz, yy, yz, zz. Only its tangential part acts.
using Tensor = std::array<double, 6>;

/// Both matrices, and the area of every element.
struct AssembledMatrices {
  SparseMatrix mass, stiffness;
  std::vector<double> area;
};

/// Connectivity of the matrices of a discretisation, made once and used for every matrix.
class Assembler {
 public:
  /// Keeps a reference to the discretisation.
  explicit Assembler(const Discretisation& discretisation)
      : d_(discretisation), matrices_(d_.unknowns, d_.first_function, d_.function) {}

  const std::shared_ptr<const SparsePattern>& pattern() const { return matrices_.pattern(); }

  /// M_ij = integral of c phi_i phi_j; `factor`: c at the quadrature points, empty for 1. Square: [area].
  SparseMatrix mass(const std::vector<Point>& control, const std::vector<double>& factor = {}) const;

  /// The same bits as mass() and stiffness(), in less time than the two.
  AssembledMatrices mass_and_stiffness(const std::vector<Point>& control) const;

  /// K_ij = integral of grad phi_i . c grad phi_j, positive semidefinite for c >= 0 (the weak form of -div c grad).
  SparseMatrix stiffness(const std::vector<Point>& control, const std::vector<double>& factor = {}) const;

  /// K_ij = integral of grad phi_i . T grad phi_j for a tensor at each quadrature point.
  SparseMatrix stiffness(const std::vector<Point>& control, const std::vector<Tensor>& tensor) const;

 private:
  const Discretisation& d_;
  ElementMatrices matrices_;
};

/// out(i, j) += sum over q of left(q, i) right(q, j): the product of two tables of basis functions (points x
/// functions), with a fast path for regular Loop elements that gives the same bits as the plain one.
void add_basis_product(const RowMatrix& left, const double* right, double* out);
void add_basis_product_plain(const RowMatrix& left, const double* right, double* out);

}  // namespace pelage
