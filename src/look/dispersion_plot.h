#pragma once
// The dispersion relation of a model as a plot.

#include <string>

#include "look/plot.h"
#include "react/stability.h"

namespace pelage {

/// Growth rate (and frequency, where it is not zero) of the fastest branch over the wave number, with the unstable band
/// and the fastest wave. Lengths and times in model units. Needs a steady state.
Plot dispersion_plot(const Stability& stability, const std::string& title, const std::string& subtitle);

}  // namespace pelage
