#pragma once
// What linear theory says about patterns, in words: which regime a uniform state is in, which conditions hold, and how
// far the diffusions are from the threshold.

#include <optional>
#include <string>
#include <vector>

#include "react/stability.h"

namespace pelage {

/// What becomes of small deviations from a uniform state.
enum class Regime {
  no_state,      ///< there is no uniform steady state
  quiet,         ///< all decay
  marginal,      ///< the fastest wave neither grows nor decays
  turing,        ///< waves of a finite length grow and stand; the uniform state by itself is stable
  waves,         ///< the same, but they travel or oscillate
  oscillation,   ///< the state as a whole oscillates with growing amplitude (Hopf), and no finite wave outgrows it
  departure,     ///< the state as a whole is left, without oscillating, and no finite wave outgrows it
  mixed,         ///< the uniform state is unstable, and waves of a finite length grow faster still
  ever_shorter,  ///< the shorter the wave, the faster it grows: the equations set no size
};

Regime regime_of(const Stability& stability);

/// One line: "a Turing pattern: ...".
std::string describe(Regime regime);

/// A condition for diffusion to drive a pattern out of a stable uniform state.
struct Condition {
  std::string text;  ///< with its numbers: "trace of the Jacobian -0.05 < 0"
  bool holds = false;
};

/// For two species the four classical inequalities (Murray 2003, Mathematical Biology II, eqs 2.31), with f_u the first
/// entry of the Jacobian; for others, and coupled ones, the same statement over all eigenvalues and wave numbers. Empty
/// without a state.
std::vector<Condition> turing_conditions(const Stability& stability, const std::vector<std::string>& species);

/// Where growth of waves begins or ends when one diffusion varies and the others stay.
struct DiffusionThreshold {
  std::size_t species = 0;
  double diffusion = 0;     ///< the nearest value at which growth changes sign [model length^2 / time]
  bool grows_above = true;  ///< waves grow for larger values, otherwise for smaller ones
};

/// For every species that diffuses, the nearest threshold within a factor of 10^4 on either side, if there is one and
/// the uniform state is stable: by bisection over the dispersion relation, for any number of species.
std::vector<DiffusionThreshold> diffusion_thresholds(const Stability& stability);

/// The thresholds in words: "no pattern: D_a / D_b must be above 4, here it is 3.5". For two species one line, since
/// only the ratio counts; for more one line per species.
std::vector<std::string> describe(const std::vector<DiffusionThreshold>& thresholds, const Stability& stability,
                                  const std::vector<std::string>& species);

}  // namespace pelage
