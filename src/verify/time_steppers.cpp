#include <cmath>

#include "discretise/surface_space.h"
#include "shape/generators.h"
#include "time/stepper.h"
#include "verify/figure.h"
#include "verify/problem.h"

namespace pelage {

namespace {

/// FitzHugh-Nagumo: R_u = u - u^3 - v = (1 - u^2) u - v, R_v = (u - v) / 2.
Reaction fitzhugh_nagumo() {
  Reaction r;
  r.rates = [](const FieldPointers& u, double, std::size_t begin, std::size_t end, const MutableFieldPointers& rate) {
    for (std::size_t s = begin; s < end; ++s) {
      rate[0][s] = u[0][s] - u[0][s] * u[0][s] * u[0][s] - u[1][s];
      rate[1][s] = (u[0][s] - u[1][s]) / 2;
    }
  };
  r.split = [](const FieldPointers& u, double, std::size_t begin, std::size_t end, const MutableFieldPointers& c2,
               const MutableFieldPointers& c3) {
    for (std::size_t s = begin; s < end; ++s) {
      c2[0][s] = 1 - u[0][s] * u[0][s];
      c3[0][s] = -u[1][s];
      c2[1][s] = -0.5;
      c3[1][s] = u[0][s] / 2;
    }
  };
  return r;
}

/// The state at time 1 after `steps` equal steps from a smooth initial state.
std::vector<Vector> integrate(const Problem& p, const StepperKind& kind, int steps) {
  const Assembler assembler(p.discretisation);
  const SampledMass sampled = surface_space(p.discretisation, p.control, 2)->sampled(kind.samples);
  const auto stiffness = std::make_shared<const SparseMatrix>(p.stiffness);
  System system;
  system.mass = sampled.mass;
  system.sampling = sampled.sampling;
  for (const auto& [name, diffusion] : {std::pair{"u", 0.01}, std::pair{"v", 0.0}}) {
    Species& s = system.species.emplace_back();
    s.name = name;
    s.diffusion = diffusion;
    s.stiffness = stiffness;
  }
  system.reaction = fitzhugh_nagumo();
  system.weighted_mass = [&](const Vector& f) {
    return assembler.mass(p.control, std::vector<double>(f.begin(), f.end()));
  };
  State state;
  Vector u(p.discretisation.unknowns), v(p.discretisation.unknowns);
  for (std::size_t i = 0; i < p.control.size(); ++i) {
    u[static_cast<Eigen::Index>(i)] = p.control[i][0] + 0.3 * p.control[i][1] * p.control[i][2];
    v[static_cast<Eigen::Index>(i)] = 0.5 * p.control[i][2];
  }
  state.now = {u, v};
  const auto stepper = kind.make();
  for (int k = 0; k < steps; ++k) stepper->step(system, state, {.dt = 1.0 / steps, .solver_tolerance = 1e-13});
  return state.now;
}

double distance(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  return std::sqrt((a[0] - b[0]).squaredNorm() + (a[1] - b[1]).squaredNorm());
}

/// Observed order from three runs of the same scheme, with steps in the ratio 4 : 2 : 1: no reference is needed.
double observed_order(const Problem& p, const StepperKind& stepper, int steps) {
  const auto coarse = integrate(p, stepper, steps), middle = integrate(p, stepper, 2 * steps),
             fine = integrate(p, stepper, 4 * steps);
  return std::log2(distance(coarse, middle) / distance(middle, fine));
}

}  // namespace

std::vector<Figure> verify_time_steppers() {
  const Problem p = make_problem(builtin_shape("builtin:sphere?n=642"), make_loop, false);
  std::vector<Figure> figures;
  for (const auto& [kind, order] : {std::pair{&semi_implicit, 1}, std::pair{&sbdf2, 2}, std::pair{&explicit_euler, 1}})
    figures.push_back(
        at_most("distance of the order in time of " + std::string(kind->name) + " from " + std::to_string(order),
                std::abs(observed_order(p, *kind, 32) - order), 0.1));
  return figures;
}

}  // namespace pelage
