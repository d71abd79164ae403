#pragma once
// Multilinear finite elements on a grid (grid_cells.h) as a Space: lines, sheets and volumes.

#include <memory>
#include <mutex>
#include <optional>

#include "discretise/element_matrices.h"
#include "discretise/grid_cells.h"
#include "discretise/space.h"
#include "pelage/atlas.h"

namespace pelage {

/// Coefficients are the values at the nodes. Matrices are made when they are first asked for. Normals are those of
/// sheets, seen from where the first axis turns counter-clockwise to the second (at the nodes of one-sided surfaces
/// from either side); lines and volumes have (0, 0, 1), and no curvature. Reactions act at the nodes as load(f) = M f.
class GridSpace final : public Space {
 public:
  /// Error(Fault::input) for grids that are not sound.
  explicit GridSpace(Grid grid);
  /// On the nodes of sewn patches; nothing knows its element points.
  explicit GridSpace(const Atlas& atlas);

  Index unknowns() const override { return static_cast<Index>(grid_.nodes()); }
  SampledMass sampled(SampleRule rule) const override;
  const SparseMatrix& node_values() const override;
  SparseMatrix quadrature_values() const override;
  SharedMatrix stiffness() const override;
  SparseMatrix weighted_mass(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<Tensor>& c) const override;
  Vector gradient_product(SampleRule rule, const Vector& u, const Vector& v) const override;
  /// Of a triangle of mesh_of(grid).
  ElementPoint element_point(Index face, double v, double w) const override;
  PlaceGeometry geometry(SampleRule rule, bool with_curvature) const override;
  std::vector<double> at_quadrature_points(const std::vector<double>& at_nodes) const override;
  /// In volumes d is the line's own direction and n n' all that is across it; Error(Fault::usage) for a theta other
  /// than 0. Along lines there is nothing but d.
  std::vector<Tensor> tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const override;
  std::vector<char> interior(std::vector<char> nodes) const override;
  SpaceBorder border(const std::string& side) const override;
  const Lattice* lattice() const override { return lattice_ ? &*lattice_ : nullptr; }
  const std::vector<Point>& control() const override;
  std::shared_ptr<const Space> moved(std::vector<Point> control) const override;

 private:
  struct Connectivity {
    GridCells cells;
    ElementMatrices matrices;
    explicit Connectivity(GridCells all) : cells(std::move(all)), matrices(cells.nodes, cells.first, cells.corner) {}
  };
  struct SharedConnectivity {
    std::once_flag once;
    std::unique_ptr<const Connectivity> made;
  };
  struct Matrices {
    SharedMatrix mass, stiffness;
  };
  GridSpace(Grid grid, int dimension, std::shared_ptr<SharedConnectivity> connectivity);

  const Connectivity& connectivity() const;
  const GridCells& cells() const { return connectivity().cells; }
  std::size_t points_per_cell() const { return static_cast<std::size_t>(rule_.points); }
  std::size_t quadrature_points() const { return points_per_cell() * cells().count(); }
  template <class Body>
  void for_each_cell(const Body& body) const;
  const CellPoints& points_of(std::size_t cell, CellPoints& scratch) const;
  template <class Coefficient>
  SparseMatrix stiffness_of(const Coefficient& coefficient) const;
  const Matrices& matrices() const;
  Sampling vertex_sampling(const SparseMatrix& mass) const;
  Sampling quadrature_sampling() const;
  const std::vector<SparseMatrix>& mean_gradients() const;
  std::vector<Point> positions(SampleRule rule) const;
  std::vector<Point> normals(SampleRule rule) const;
  std::vector<Tensor> curvature(SampleRule rule) const;
  /// -1 where the normal is on the other side of a one-sided surface than that of the cell, else 1.
  double side(const Point& normal, const CellPoint& p) const;
  std::vector<Point> sides() const;
  template <class Value, class At>
  std::vector<Value> around_nodes(const std::vector<Point>& normal, const At& at_point) const;

  Grid grid_;  ///< without attributes; of an atlas a row of all its nodes
  int dimension_;
  CellRule rule_;
  std::optional<CellPoints> even_;  ///< of every cell
  std::optional<Lattice> lattice_;
  std::shared_ptr<SharedConnectivity> connectivity_;

  // Made when they are first asked for.
  mutable std::once_flag matrices_once_, control_once_, values_once_, gradients_once_, vertices_once_, quadrature_once_;
  mutable Matrices matrices_;
  mutable std::vector<Point> control_;  ///< of even grids
  mutable SparseMatrix values_;
  mutable std::vector<SparseMatrix> mean_gradients_;
  mutable SampledMass at_vertices_, at_quadrature_;
};

/// What GridSpace::tensors gives at every place of a lattice for one line and the first of the rates.
Tensor lattice_tensor(const Lattice& lattice, const Tensor& line, const Kinetics::TensorField& rates);

}  // namespace pelage
