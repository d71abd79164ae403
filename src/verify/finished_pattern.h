#pragma once
// Finished patterns: is there one, and how large is it.

#include <string>

#include "run/run.h"

namespace pelage {

struct FinishedPattern {
  RunStatus status = RunStatus::running;
  std::string message;    ///< of a failure
  double contrast = 0;    ///< of the shown (last) species: root mean square deviation from the mean over the surface,
                          ///< divided by the largest absolute value that it has there now or had at the start
  double wavelength = 0;  ///< of the species that diffuses fastest, whose pattern has the fewest harmonics
  double shown_wavelength = 0;  ///< of the shown species; both in model length units, see spectral_wavelength
};

/// 2 pi over the mean wave number sqrt(l (l + 1)) of a field on the unit sphere, weighted with the power in the degrees
/// l = 1 .. 40 of spherical harmonics.
double spectral_wavelength(const Sampling& sampling, const Vector& coefficients);

/// Runs a program to its stop. The wavelength is taken of the species that diffuses fastest, whose pattern has the
/// fewest harmonics, and only means something on the unit sphere.
FinishedPattern finish_pattern(Program program);

}  // namespace pelage
