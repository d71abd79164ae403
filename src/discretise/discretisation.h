#pragma once
// A discretisation is data: basis functions tabulated at quadrature points. Matrices are assembled from it the same way
// for every method (assembly.h), and nothing else of the program knows which method it is.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "linalg/sparse.h"
#include "shape/topology.h"

namespace pelage {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Basis functions of all triangles with the same neighbourhood, at the quadrature points of the reference triangle.
struct ElementClass {
  RowMatrix value, dv, dw;  ///< points x basis functions: phi, d phi / dv, d phi / dw
  RowMatrix dvv, dvw, dww;  ///< second derivatives; empty where the surface has no curvature inside its elements
  Vector weight;            ///< quadrature weights; their sum is 1/2, the area of the reference triangle
  std::vector<std::array<double, 2>> place;  ///< (v, w) of the points

  Index points() const { return static_cast<Index>(weight.size()); }
  Index functions() const { return static_cast<Index>(value.cols()); }
};

/// Basis functions of an element at any of its points.
class ElementBasis {
 public:
  virtual ~ElementBasis() = default;
  /// Rows: phi, d phi / dv, d phi / dw of the element's basis functions (columns, in the order of
  /// Discretisation::function) at (1-v-w) a + v b + w c.
  virtual RowMatrix at(std::size_t element, double v, double w) const = 0;
};

/// Coefficients are the values at control vertices; samples are the values of the function at the (limit) positions of
/// the vertices. They coincide for linear elements only: sample = values * coefficients.
struct Discretisation {
  Index unknowns = 0;  ///< number of basis functions = number of control vertices
  bool nodal = false;  ///< coefficients are the samples at the vertices
  std::shared_ptr<const Topology> topology;
  std::vector<ElementClass> classes;
  std::vector<Index> element_class;          ///< per triangle
  std::vector<std::int64_t> first_function;  ///< per triangle + 1: where its basis functions begin in `function`
  std::vector<Index> function;               ///< numbers of the basis functions of all triangles, one after the other
  std::vector<std::int64_t> first_point;     ///< per triangle + 1: number of its first quadrature point
  SparseMatrix values;                       ///< samples x unknowns: the basis functions at the vertices
  SparseMatrix tangent1, tangent2;           ///< samples x unknowns: tangents at the vertices (Loop only; may be empty)
  std::shared_ptr<const ElementBasis> basis;

  std::size_t elements() const { return element_class.size(); }
};

/// How often triangles are split into four before the 6-point rule (exact for quartics) is applied to the parts.
struct LoopQuadrature {
  int regular_splits = 0;
  int irregular_splits = 1;  ///< of triangles with an extraordinary corner
};

/// Loop finite elements (Cirak, Ortiz, Schroeder 2000). Throws Error(Fault::input) when a valence is above
/// max_loop_valence.
Discretisation loop_discretisation(std::shared_ptr<const Topology> topology, const LoopQuadrature& quadrature = {});
Discretisation loop_discretisation(Topology topology, const LoopQuadrature& quadrature = {});

/// Control points whose limit surface goes through the points.
std::vector<Point> loop_interpolation(const Topology& topology, const std::vector<Point>& points);

/// Linear finite elements (the cotangent method) on the flat triangles: 3-point quadrature at the edge midpoints, exact
/// for quadratics, hence for the mass matrix.
Discretisation linear_discretisation(std::shared_ptr<const Topology> topology);
Discretisation linear_discretisation(Topology topology);

/// A vertex of valence n couples n^2 pairs of unknowns: above this the matrices lose their sparsity.
inline constexpr Index max_loop_valence = 200;

}  // namespace pelage
