#pragma once
// Linear finite elements on tetrahedra as a Space.

#include <memory>
#include <mutex>

#include "discretise/element_matrices.h"
#include "discretise/space.h"
#include "pelage/tet_mesh.h"

namespace pelage {

/// Coefficients are the values at the nodes. The mass is the mean of the consistent one and its row sums, which cancel
/// each other's errors (see blended_sampling); reactions act at the nodes as load(f) = M f. Every tetrahedron has four
/// quadrature points, exact for squares. Normals are those of the skin, outwards, and 0 inside; there is no curvature.
class TetSpace final : public Space {
 public:
  /// Error(Fault::input) for node numbers that are none and tetrahedra without volume.
  explicit TetSpace(const TetMesh& volume);

  Index unknowns() const override { return static_cast<Index>(points_.size()); }
  SampledMass sampled(SampleRule rule) const override;
  const SparseMatrix& node_values() const override;
  SparseMatrix quadrature_values() const override;
  SharedMatrix stiffness() const override { return matrices().stiffness; }
  SparseMatrix weighted_mass(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<Tensor>& c) const override;
  Vector gradient_product(SampleRule rule, const Vector& u, const Vector& v) const override;
  /// Of a triangle of mesh_of(volume), the skin.
  ElementPoint element_point(Index face, double v, double w) const override;
  PlaceGeometry geometry(SampleRule rule, bool with_curvature) const override;
  std::vector<double> at_quadrature_points(const std::vector<double>& at_nodes) const override;
  /// With lines or planes, see volume_tensor; Error(Fault::usage) for a theta other than 0.
  std::vector<Tensor> tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const override;
  std::vector<char> interior(std::vector<char> nodes) const override;
  /// "skin": all of it.
  SpaceBorder border(const std::string& name) const override;
  const std::vector<Point>& control() const override { return points_; }
  std::shared_ptr<const Space> moved(std::vector<Point> control) const override;

 private:
  struct Connectivity {
    std::vector<std::int64_t> first;  ///< per tetrahedron + 1: of its corners
    std::vector<Index> corner;
    std::vector<Triangle> skin;
    ElementMatrices matrices;
    explicit Connectivity(const TetMesh& volume);
  };
  struct Matrices {
    SharedMatrix consistent, stiffness;
  };
  struct Tet {
    double volume;
    std::array<Eigen::Vector3d, 4> gradient;  ///< of the corners' functions
  };
  TetSpace(std::vector<Point> points, std::shared_ptr<const Connectivity> connectivity);

  std::size_t tets() const { return connectivity_->first.size() - 1; }
  Tet tet(std::size_t t) const;
  template <class Body>
  void for_each_tet(const Body& body) const;
  template <class Coefficient>
  SparseMatrix stiffness_of(const Coefficient& coefficient) const;
  const Matrices& matrices() const;
  SampledMass nodal() const;
  SampledMass at_points() const;
  const std::array<SparseMatrix, 3>& mean_gradients() const;
  std::vector<Point> positions(SampleRule rule) const;

  std::vector<Point> points_;
  std::shared_ptr<const Connectivity> connectivity_;

  // Made when they are first asked for.
  mutable std::once_flag matrices_once_, values_once_, gradients_once_, nodal_once_, points_once_;
  mutable Matrices matrices_;
  mutable SparseMatrix values_;
  mutable std::array<SparseMatrix, 3> mean_gradients_;
  mutable SampledMass nodal_, at_points_;
};

}  // namespace pelage
