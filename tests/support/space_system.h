#pragma once
// Systems with matrices on a space, without a model.

#include "discretise/space.h"
#include "support/split_reaction.h"
#include "time/stepper.h"

namespace pelage {

struct SpaceSystem {
  explicit SpaceSystem(std::shared_ptr<const Space> on, SampleRule rule = SampleRule::vertices) : space(std::move(on)) {
    const SampledMass sampled = space->sampled(rule);
    system.mass = sampled.mass;
    system.sampling = sampled.sampling;
    system.weighted_mass = [of = space](const Vector& f) {
      return of->weighted_mass(std::vector<double>(f.begin(), f.end()));
    };
    set_reaction(system, [](auto&&...) {});
  }
  SpaceSystem(const SpaceSystem&) = delete;
  SpaceSystem& operator=(const SpaceSystem&) = delete;

  /// `start`: of the coefficient of a control point.
  void add_species(double diffusion, const std::function<double(const Point&)>& start) {
    Species& s = system.species.emplace_back();
    s.name = "u" + std::to_string(system.species.size());
    s.diffusion = diffusion;
    s.stiffness = space->stiffness();
    Vector& u = state.now.emplace_back(space->unknowns());
    for (Index v = 0; v < space->unknowns(); ++v) u[v] = start(space->control()[static_cast<std::size_t>(v)]);
  }

  std::shared_ptr<const Space> space;
  System system;
  State state;
};

}  // namespace pelage
