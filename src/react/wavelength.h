#pragma once
// How large the pattern of a model becomes.

#include <optional>

#include "react/model.h"

namespace pelage {

/// Spacing of the finished pattern in model length units, at the parameters in use:
///   - the formula `wavelength` of the model's file, where there is one;
///   - the measured number of the file or variant, which holds at the values given there, times the ratio of the
///   formula
///     here to that there, where there is one. Without a formula, times sqrt(c / r) where the parameters multiply all
///     diffusions by c and all rates by r (the equations are the same in other units of length and time; c = r = 1
///     where only the start differs); else times the ratio of the fastest waves of linear theory, where both here and
///     there waves grow and stand and the number is close to that wave;
///   - the fastest wave of linear theory, where the file gives nothing.
/// Error(usage), located, when all of it fails, and when the formula is no length: then a size has no meaning.
double model_wavelength(const Model& model);

/// The same, or nothing.
std::optional<double> known_wavelength(const Model& model);

/// 2 pi sqrt(D/r) with the smallest diffusion D and the fastest rate r (largest modulus of an eigenvalue) about the
/// steady state nearest to the initial values: the wave on which diffusion is as fast as the reaction [model length].
/// Fronts are about as wide as a part of it; the spacing of shipped models is 1.2 to 8 times as much. Nothing without a
/// steady state, and where species are coupled by Laplacians.
std::optional<double> diffusion_length(const Model& model);

/// Whether the model's file says something about the wavelength, so that it is not that of linear theory.
bool states_wavelength(const ModelSource& source);

}  // namespace pelage
