#pragma once
// Finite elements on a triangulated surface as a Space.

#include <memory>
#include <mutex>
#include <optional>

#include "discretise/discretisation.h"
#include "discretise/gradients.h"
#include "discretise/space.h"

namespace pelage {

class SurfaceSpace final : public Space {
 public:
  /// What does not depend on where the surface is.
  struct Connectivity {
    Discretisation discretisation;
    Assembler assembler;
    int reach;          ///< rings of triangles around a vertex that its basis function covers
    double consistent;  ///< share of the consistent mass at the nodes of linear elements; 0: as vertex_sampling has it

    Connectivity(Discretisation d, int rings, double share)
        : discretisation(std::move(d)), assembler(discretisation), reach(rings), consistent(share) {}
  };

  SurfaceSpace(std::shared_ptr<const Connectivity> connectivity, std::vector<Point> control);

  const Discretisation& discretisation() const { return connectivity_->discretisation; }

  Index unknowns() const override { return discretisation().unknowns; }
  SampledMass sampled(SampleRule rule) const override;
  const SparseMatrix& node_values() const override { return discretisation().values; }
  SparseMatrix quadrature_values() const override;
  SharedMatrix stiffness() const override;
  SparseMatrix weighted_mass(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<Tensor>& c) const override;
  Vector gradient_product(SampleRule rule, const Vector& u, const Vector& v) const override;
  ElementPoint element_point(Index face, double v, double w) const override;
  PlaceGeometry geometry(SampleRule rule, bool with_curvature) const override;
  std::vector<double> at_quadrature_points(const std::vector<double>& at_nodes) const override;
  std::vector<Tensor> tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const override;
  std::vector<char> interior(std::vector<char> nodes) const override;
  const std::vector<Point>& control() const override { return control_; }
  std::shared_ptr<const Space> moved(std::vector<Point> control) const override;

 private:
  std::shared_ptr<const Connectivity> connectivity_;
  std::vector<Point> control_;
  void assemble() const;
  const Gradients& gradients() const;

  // Made when they are first asked for.
  mutable std::mutex making_;
  mutable SharedMatrix stiffness_;
  mutable std::optional<AssembledMatrices> assembled_;  ///< until the samples are made of it
  mutable SampledMass at_vertices_, at_quadrature_;
  mutable std::unique_ptr<const Gradients> gradients_;
  mutable std::shared_ptr<const Sampling> earlier_;  ///< at the vertices, of another place, which shares its matrices
};

std::shared_ptr<const SurfaceSpace> surface_space(Discretisation discretisation, std::vector<Point> control, int reach,
                                                  double consistent = 0);

}  // namespace pelage
