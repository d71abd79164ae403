#pragma once
// What linear theory says about patterns, in words: which regime a uniform state is in, which conditions hold, and how
// far the diffusions are from the threshold.

#include <string>
#include <vector>

#include "pelage/stability.h"

namespace pelage {

Regime regime_of(const Stability& stability);

/// For two species, each with its own diffusion, the four classical inequalities (Murray 2003, Mathematical Biology II,
/// eqs 2.31), with f_u the first entry of the Jacobian; for others the same statement over all eigenvalues and wave
/// numbers. Empty without a state.
std::vector<Condition> turing_conditions(const Stability& stability, const std::vector<std::string>& species);

/// For every species that diffuses, the nearest threshold within a factor of 10^4 on either side, if there is one and
/// the uniform state is stable: by bisection over the dispersion relation, for any number of species.
std::vector<DiffusionThreshold> diffusion_thresholds(const Stability& stability);

/// The thresholds in words: "no pattern: D_a / D_b must be above 4, here it is 3.5". For two species one line, since
/// only the ratio counts; for more one line per species.
std::vector<std::string> describe(const std::vector<DiffusionThreshold>& thresholds, const Stability& stability,
                                  const std::vector<std::string>& species);

}  // namespace pelage
