#pragma once
// The equations of a stage on a space: what its steppers see.

#include <functional>
#include <memory>
#include <span>

#include "discretise/anisotropy.h"
#include "run/material.h"
#include "time/system.h"

namespace pelage {

class StageSystem {
 public:
  /// Error(Fault::usage) for diffusions that are negative somewhere. The stage has to outlive it.
  StageSystem(const StageProgram& stage, std::shared_ptr<const Space> space, std::shared_ptr<const Material> material);

  const System& system() const { return system_; }
  const Space& space() const { return *space_; }

  /// Coefficients of the initial state.
  std::vector<Vector> initial() const;
  /// Brings diffusions that depend on time or on the fields up to date; to be called before every step.
  void update(const State& state);

  /// The largest ratio of the rates along and across of species i, which is anisotropic or has a tensor.
  double anisotropy(std::size_t i) const;

 private:
  struct Coefficients {
    std::vector<Vector> c0, c1;
  };
  static Coefficients evaluate_diffusion(const Kinetics& kinetics, const std::vector<Vector>& fields, double time);
  std::shared_ptr<const Kinetics> kinetics_at(SampleRule rule, Kinetics::Parts parts) const;
  void sample_space();
  void add_species(std::size_t i);
  void couple_species();
  void add_reaction();
  void add_own_reaction();
  void add_gradients();
  void add_borders();
  void fill_own_stiffness(std::size_t i);
  void fill_variable(std::size_t i, const State* state);
  std::vector<Vector> fields_at(SampleRule rule, const SparseMatrix& values, const State* state) const;
  std::vector<double> c1_at_quadrature(std::size_t species, const State* state) const;
  std::vector<Tensor> tensors_at_quadrature(std::size_t species, const State* state) const;
  bool share_diffusion(std::size_t i);
  Vector c0_at_samples(std::size_t species, const State* state) const;

  const StageProgram* stage_;
  std::shared_ptr<const Space> space_;
  std::shared_ptr<const Material> material_;
  std::shared_ptr<const Kinetics> kinetics_;  ///< at the samples
  std::shared_ptr<const Kinetics>
      quadrature_kinetics_;  ///< at the quadrature points, for diffusion that varies and fluxes
  SparseMatrix quadrature_values_;
  std::shared_ptr<const Borders> borders_;  ///< null without conditions
  bool matrix_free_ = false;
  System system_;
};

}  // namespace pelage
