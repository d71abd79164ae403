#pragma once
// What a stepper sees: the semi-discrete system  M du_i/dt = -K_i u_i + load(R_i(u, t)),  one row per species i,
// the generalised PDE (2) of Bajaj, Zhang, Xu 2008 after discretisation in space, and the state that it advances.
// Coupled species have M du_i/dt = -sum_j D_ij K u_j + load(R_i), or, where algebraic, M u_i = -sum_j D_ij K u_j +
// load(R_i) with an R_i that depends on evolving species only. R may also depend on products of gradients, and fluxes
// -integral of c grad u_j . grad phi may be added to the loads: steppers take both explicitly.

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "discretise/lattice.h"
#include "discretise/sampling.h"
#include "linalg/conjugate_gradient.h"
#include "linalg/sparse.h"

namespace pelage {

/// Values of all species at the same samples: one pointer per species, then one per product of gradients.
using FieldPointers = std::vector<const double*>;
using MutableFieldPointers = std::vector<double*>;

/// The reaction, or its Jacobian, at one time in single precision, for `count` samples from number `first` on: u[i][k]
/// and rate[i][k] belong to sample first + k. Called from several threads for disjoint ranges.
using FloatRates = std::function<void(std::span<const float* const> u, std::size_t first, std::size_t count,
                                      std::span<float* const> rate)>;

/// The reaction at samples [begin, end) at time t; called from several threads for disjoint ranges.
struct Reaction {
  /// rate[i][s] = R_i(u_s, t).
  std::function<void(const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                     const MutableFieldPointers& rate)>
      rates;
  /// `rates` at a time t in single precision; empty: steppers that compute in it convert those of `rates`.
  std::function<FloatRates(double t)> float_rates;
  /// dR_i/du_j, between jumps, as rate[i * species + j]; empty: steppers go by differences alone.
  std::function<FloatRates(double t)> float_jacobian;
  /// R_i = c2_i u_i + c3_i, the split of eq. (2) that the semi-implicit Euler scheme needs; empty: steppers that
  /// take it where it is there go without.
  std::function<void(const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                     const MutableFieldPointers& c2, const MutableFieldPointers& c3)>
      split;
};

struct Species {
  std::string name;
  double diffusion = 0;  ///< D >= 0 [length^2/time]; multiplies `stiffness`
  SharedMatrix stiffness;
  /// Where C0 varies: mass matrix and sample weights of this species, divided by C0 (eqs (9)-(11) of the paper); null:
  /// those of the system.
  SharedMatrix mass;
  SharedVector weight;
  /// On a lattice, where the diffusion is the same everywhere: its tensor [length^2/time].
  std::optional<Eigen::Matrix3d> tensor;
  std::shared_ptr<const Held> held;  ///< coefficients that stay, or that System::set_values gives; null: System::held
  bool coupled = false;              ///< part of System::coupled, which then holds the diffusion instead
  bool algebraic = false;
  bool follows = false;  ///< algebraic, and no step needs it: steppers leave it alone, see follow()
  double lower = -std::numeric_limits<double>::infinity();  ///< clamps of the coefficients after a step; as the basis
  double upper = std::numeric_limits<double>::infinity();   ///< functions are non-negative they bound the field too
};

/// Species that are linked by constant coefficients of Laplacians and are solved for together.
struct CoupledSpecies {
  std::vector<std::size_t> index;  ///< into System::species; empty when there are none
  Eigen::MatrixXd diffusion;       ///< D_ij [length^2/time; length^2 in algebraic rows], row and column k: index[k]
  SharedMatrix stiffness;          ///< of unit diffusion
};

struct System {
  const Lattice* lattice = nullptr;  ///< the even grid whose nodes the unknowns are; null: there is none
  /// = values' W values of `sampling`; null where steppers go by the lattice alone: then there are no matrices, and
  /// `sampling` has only its weights.
  SharedMatrix mass;
  std::shared_ptr<const Sampling> sampling;
  std::vector<Species> species;
  CoupledSpecies coupled;
  std::shared_ptr<const Held> held;  ///< coefficients that stay as they are, of all species; null: none
  Reaction reaction;
  /// Appends what rates read behind the species, products of gradients, to the samples of all species; empty: nothing.
  std::function<void(const std::vector<Vector>& coefficients, std::vector<Vector>& samples)> add_gradients;
  /// Puts the values that are given for a species at time t, at unknowns that are held, into its coefficients. Empty:
  /// none are given.
  std::function<void(std::size_t species, double t, Vector& coefficients)> set_values;
  /// The loads of the fluxes at time t, which sum to what comes in at borders: one field per species, empty where it
  /// has none. Empty: there are none.
  std::function<std::vector<Vector>(const std::vector<Vector>& coefficients, double t)> fluxes;
  /// Mass matrix weighted by a factor at the samples; only semi-implicit Euler needs it.
  std::function<SparseMatrix(const Vector& factor)> weighted_mass;
};

inline const SharedMatrix& mass_of(const System& system, std::size_t species) {
  const SharedMatrix& own = system.species[species].mass;
  return own ? own : system.mass;
}
/// Null where none are.
inline const Held* held_of(const System& system, std::size_t species) {
  const auto& own = system.species[species].held;
  return own ? own.get() : system.held.get();
}
inline const Vector& weight_of(const System& system, std::size_t species) {
  const SharedVector& own = system.species[species].weight;
  return own ? *own : system.sampling->weight;
}

/// The only thing that a run changes; what a checkpoint stores.
struct State {
  double time = 0;
  std::int64_t step = 0;
  std::vector<Vector> now;                ///< coefficients per species
  std::vector<std::vector<Vector>> past;  ///< up to two earlier states, the latest first
  std::vector<double> past_steps;         ///< past_steps[k]: time between states k and k+1 back
  std::vector<Vector> past_rates;         ///< reaction at the latest earlier state, at the samples, and then
                                          ///< its fluxes, if the system has any (SBDF2); or C2 at the samples, of which
                                          ///< matrices were made that are kept (StepperKind::refreshes)
};

}  // namespace pelage
