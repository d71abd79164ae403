#pragma once
// Finite volumes on Turk's cells (pelage/cells.h) as a Space.

#include <memory>

#include "discretise/method.h"
#include "discretise/space.h"
#include "shape/cell_shapes.h"

namespace pelage {

/// Coefficients are the values at the points, which are samples and quadrature points as well; the mass of a cell is
/// its area. Between two cells flows (u_j - u_i) l_ij / d_ij, with the length of the side between them, the mean of
/// what either sees, and their distance along the surface: symmetric to the bit, and exact for linear functions in the
/// plane. Where diffusion varies it is the harmonic mean of the two, so that nothing flows into what does not diffuse;
/// where it has directions the sides are those of cells whose neighbours have been moved by T^-1/2 (Turk 1991:
/// contracted along the direction of faster diffusion).
class CellSpace final : public Space {
 public:
  enum class Coefficients {
    volumes,  ///< as above
    turk      ///< as Turk 1991 has them: the lengths of the sides, made to sum to 4 in every cell, all of one size
  };
  explicit CellSpace(Cells cells, Coefficients coefficients = Coefficients::volumes);

  Index unknowns() const override { return static_cast<Index>(cells_.nodes()); }
  SampledMass sampled(SampleRule) const override { return sampled_; }
  const SparseMatrix& node_values() const override { return sampled_.sampling->values; }
  SparseMatrix quadrature_values() const override { return node_values(); }
  SharedMatrix stiffness() const override { return stiffness_; }
  SparseMatrix weighted_mass(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<Tensor>& c) const override;
  /// By least squares over the neighbours.
  Vector gradient_product(SampleRule rule, const Vector& u, const Vector& v) const override;
  /// Of a triangle of `cells.on`, with the weights of CellValues.
  ElementPoint element_point(Index face, double v, double w) const override;
  PlaceGeometry geometry(SampleRule rule, bool with_curvature) const override;
  std::vector<double> at_quadrature_points(const std::vector<double>& at_nodes) const override { return at_nodes; }
  std::vector<Tensor> tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const override;
  std::vector<char> interior(std::vector<char> nodes) const override;
  const std::vector<Point>& control() const override { return cells_.points; }
  /// Error(Fault::usage): cells stay where they are.
  std::shared_ptr<const Space> moved(std::vector<Point> control) const override;

  const Cells& cells() const { return cells_; }
  const std::vector<double>& area() const { return area_; }
  /// Tangential, by least squares over the neighbours [1 / world].
  std::vector<Point> gradients(const Vector& u) const;
  /// Shape operators as tensors in space, as those of discretise/curvature.h.
  std::vector<Tensor> curvature() const;

 private:
  /// Lengths of sides over distances, or coefficients after Turk, as a cell sees them: per entry of its row.
  using Sides = std::vector<double>;

  void lay_out(const std::vector<PlaneCell>& shapes);
  void scale_to_world();
  PlaneCell contracted(std::size_t cell, const Tensor& t, CellShapes::Scratch& scratch, double& rate) const;
  void take_sides(std::size_t cell, const PlaneCell& shape, double rate, Sides& sides) const;
  template <class Between>
  SparseMatrix joined(const Sides& sides, const Between& between) const;
  Eigen::Matrix2d moments(std::size_t cell) const;
  std::vector<Eigen::Vector2d> slopes(const Vector& u) const;

  const Cells cells_;
  const Coefficients coefficients_;
  CellShapes shapes_;
  std::shared_ptr<const SparsePattern> pattern_;
  std::vector<std::int64_t> mirror_;  ///< per entry (i, j) that of (j, i)
  std::vector<PlanePoint> way_;       ///< per entry, in the frame of its row
  std::vector<double> area_;
  double scale_ = 1;  ///< of Turk's coefficients
  Sides sides_;
  SharedMatrix stiffness_;
  SampledMass sampled_;
};

}  // namespace pelage
