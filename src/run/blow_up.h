#pragma once
// Why a run failed, in words for the one who wrote the model: which species, how large, and where.

#include <string>
#include <vector>

#include "linalg/sparse.h"
#include "run/world.h"
#include "time/stepper.h"

namespace pelage {

/// The value that made a step fail, and what is said of it before its place.
struct Culprit {
  Runaway at;
  std::string words;
};

/// The value that stopped the step, "u becomes -2e+30", where it was one; else a rate that is not finite at the state
/// and `time`, "the rate of u is nan"; else the value furthest from 0 for its species, whose values began with
/// `first_magnitude`, "u is 17".
Culprit find_culprit(const System& system, const State& state, double time, const std::vector<double>& first_magnitude,
                     const std::optional<Runaway>& runaway);

/// "vertex 17 (0.1, 0.2, 0.3)": the vertex of the shape that is nearest to an unknown, and the place of the unknown
/// [world units]; without a shape the number of the unknown.
std::string place_in_words(const World& world, std::size_t unknown);

/// What a species that is no longer the amount it was meant to be asks for; empty if there is none. Amounts that run
/// away have mostly turned negative before: of the species without a lower bound that began above 0, everywhere or in
/// the mean, and are below it at that unknown now, the one that is meant or else the first is named.
std::string remedy_for_negative(const System& system, const std::vector<Vector>& initial,
                                const std::vector<Vector>& fields, const Runaway& at);

}  // namespace pelage
