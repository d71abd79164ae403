#pragma once
// All that a run and its time steppers know of WHERE: a space of functions with its samples and matrices. Unknowns are
// coefficients; every unknown has a node, the place whose value it stands for first of all; functions are sampled at
// the nodes or at quadrature points.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "discretise/curvature.h"
#include "discretise/lattice.h"
#include "discretise/sampling.h"
#include "react/kinetics.h"

namespace pelage {

/// Samples, and the mass matrix that they make.
struct SampledMass {
  std::shared_ptr<const Sampling> sampling;
  SharedMatrix mass;  ///< unknowns x unknowns [area], in the pattern of the stiffness
};

/// What formulas may read from places on the surface.
struct PlaceGeometry {
  std::vector<Point> position, normal;
  PrincipalCurvatures curvature;  ///< empty unless it was asked for
};

/// The functions of an element at one of its points.
struct ElementPoint {
  std::vector<Index> function;  ///< numbers of unknowns
  RowMatrix jet;                ///< rows: value, d/dv, d/dw; columns as in `function`
};

/// Nodes on a part of the border, and the integrals of products of their functions over it [world^(dimension - 1)].
/// Inflows that are given at the nodes are loads mass * inflow. Lumped masses would be wrong by a load of the second
/// order at the ends of sides, which makes an error of h^2 log(1/h) in corners.
struct SpaceBorder {
  std::vector<Index> node;  ///< ascending
  SparseMatrix mass;        ///< rows and columns as in `node`
};

/// From the entries of its mass, by pairs of nodes.
SpaceBorder border_of(const std::map<Index, std::map<Index, double>>& mass);

/// Immutable, and shared by all stages of a run.
class Space {
 public:
  virtual ~Space() = default;

  virtual Index unknowns() const = 0;
  /// At the nodes the matrix is M = B'WB with as many samples as unknowns; at quadrature points it is the reference.
  virtual SampledMass sampled(SampleRule rule) const = 0;
  /// Nodes x unknowns: the values of functions at the nodes.
  virtual const SparseMatrix& node_values() const = 0;
  /// Quadrature points x unknowns.
  virtual SparseMatrix quadrature_values() const = 0;
  /// K_ij = integral of grad phi_i . grad phi_j: positive semidefinite, K 1 = 0.
  virtual SharedMatrix stiffness() const = 0;

  /// M_ij = integral of c phi_i phi_j and K_ij = integral of grad phi_i . c grad phi_j, with a number or a tensor c at
  /// each quadrature point.
  virtual SparseMatrix weighted_mass(const std::vector<double>& c) const = 0;
  virtual SparseMatrix stiffness(const std::vector<double>& c) const = 0;
  virtual SparseMatrix stiffness(const std::vector<Tensor>& c) const = 0;

  /// grad u . grad v at the samples, of functions with these coefficients [1 / world^2]; where they have kinks at
  /// nodes, of means of their gradients around.
  virtual Vector gradient_product(SampleRule rule, const Vector& u, const Vector& v) const = 0;

  /// At (1-v-w) a + v b + w c of the triangle `face` = (a, b, c).
  virtual ElementPoint element_point(Index face, double v, double w) const = 0;

  virtual PlaceGeometry geometry(SampleRule rule, bool with_curvature) const = 0;
  /// Attributes, given at the nodes, at the quadrature points.
  virtual std::vector<double> at_quadrature_points(const std::vector<double>& at_nodes) const = 0;
  /// Diffusion tensors at the quadrature points from lines d d' at the nodes and rates at the quadrature points:
  /// T = a1^2 d d' + a2^2 n n' with d at the angle theta from the line, counter-clockwise seen from outside. On grids
  /// one line may stand for all nodes.
  virtual std::vector<Tensor> tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const = 0;
  /// Of a set of nodes (1 inside) those whose basis functions do not reach out of it.
  virtual std::vector<char> interior(std::vector<char> nodes) const = 0;

  /// The border at an end of an axis of a grid: "xmin", "xmax", "ymin", ... Empty where there is none.
  virtual SpaceBorder border(const std::string&) const { return {}; }

  /// The even grid whose nodes the unknowns are, or null.
  virtual const Lattice* lattice() const { return nullptr; }

  /// The control points, one per unknown [world units], and the space at other ones.
  virtual const std::vector<Point>& control() const = 0;
  virtual std::shared_ptr<const Space> moved(std::vector<Point> control) const = 0;
};

/// An upper estimate of the largest k^2 that the space carries: of K x = k^2 M x, by power iteration [1 / world^2].
double largest_k2(const SparseMatrix& mass, const SparseMatrix& stiffness);

}  // namespace pelage
