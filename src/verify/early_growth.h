#pragma once
// Growth of small waves in a run, to be held against linear theory.

#include <string>
#include <vector>

namespace pelage {

/// On a sphere the degrees of spherical harmonics do not mix while the deviation from the uniform state is small, so
/// that the power of each one in noise gives its growth rate without any statistics.
struct EarlyGrowth {
  std::vector<double> wave_number;  ///< of degree l: sqrt(l (l + 1)) / radius [1 / model length]
  std::vector<double> rate;         ///< [1 / model time]; minus infinity where too little is left to measure
  double wavelength = 0;            ///< of the fastest one [model length]: vertex of a parabola through three degrees
};

/// Grows noise of amplitude 1e-7 around the steady state that the analysis chooses, on a unit sphere of about
/// `vertices` vertices, scaled so that the predicted fastest wave goes about `waves` times around it. `model`: as
/// load_model takes it; a parameter named "unevenness" (noise in the kinetics) is set to 0. Error(usage) for a model
/// without a predicted wavelength.
EarlyGrowth measure_early_growth(const std::string& model, int vertices, double waves);

}  // namespace pelage
