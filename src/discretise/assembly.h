#pragma once
// Mass, stiffness and load for any discretisation: M = B' W B, K(D) = G' W D G, load = B' W f, with B the basis
// functions and G their surface gradients at the quadrature points and W the quadrature weights times the area element.
//
// Parallel and deterministic: element matrices are computed in any order, every row is summed in the order of elements.

#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "discretise/discretisation.h"
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
/// Memory: 2 bytes per entry of all element matrices (288 bytes per regular Loop triangle) besides the pattern; 4 if a
/// row could be longer than 16 bits can count.
class Assembler {
 public:
  /// Keeps a reference to the discretisation.
  explicit Assembler(const Discretisation& discretisation);

  const std::shared_ptr<const SparsePattern>& pattern() const { return pattern_; }

  /// M_ij = integral of c phi_i phi_j; `factor`: c at the quadrature points, empty for 1. Square: [area].
  SparseMatrix mass(const std::vector<Point>& control, const std::vector<double>& factor = {}) const;

  /// The same bits as mass() and stiffness(), in less time than the two.
  AssembledMatrices mass_and_stiffness(const std::vector<Point>& control) const;

  /// K_ij = integral of grad phi_i . c grad phi_j, positive semidefinite for c >= 0 (the weak form of -div c grad).
  SparseMatrix stiffness(const std::vector<Point>& control, const std::vector<double>& factor = {}) const;

  /// K_ij = integral of grad phi_i . T grad phi_j for a tensor at each quadrature point.
  SparseMatrix stiffness(const std::vector<Point>& control, const std::vector<Tensor>& tensor) const;

 private:
  struct Kernel;
  template <std::size_t count, class ElementMatrices>
  std::array<SparseMatrix, count> assemble(const ElementMatrices& element_matrices) const;
  template <class Offset>
  void build(const struct FunctionElements& incident, std::vector<Offset>& offset);
  template <class Offset>
  void build_rows(Index begin, Index end, const FunctionElements& incident, SparsePattern& part,
                  std::vector<Offset>& offset) const;

  const Discretisation& d_;
  std::shared_ptr<const SparsePattern> pattern_;
  std::vector<std::int64_t> matrix_start_;  ///< per element + 1: where its matrix begins in offset_
  /// Of an element matrix' entry within its row of the pattern.
  std::variant<std::vector<std::uint16_t>, std::vector<std::uint32_t>> offset_;
};

/// out(i, j) += sum over q of left(q, i) right(q, j): the product of two tables of basis functions (points x
/// functions), with a fast path for regular Loop elements that gives the same bits as the plain one.
void add_basis_product(const RowMatrix& left, const double* right, double* out);
void add_basis_product_plain(const RowMatrix& left, const double* right, double* out);

}  // namespace pelage
