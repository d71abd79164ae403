#pragma once
// What the equations say before anything is run: steady states, growth rates, and the size of the pattern.

#include <complex>
#include <optional>
#include <vector>

#include "react/model.h"

namespace pelage {

/// Linear stability of the spatially uniform system, with the quantities of the place at their mean (noise and
/// normal() at their mean, uniform() at its midpoint; coordinates, normals, curvatures and attributes at 0) and t = 0.
/// Lengths and times in model units; wave numbers are 2 pi / wavelength.
struct Stability {
  std::vector<std::vector<double>> steady_states;  ///< all that were found, within the bounds of the species
  std::size_t chosen = 0;         ///< the one nearest to the mean initial values; what follows is about it
  std::vector<double> jacobian;   ///< dR_i/du_j at [i * n + j]; for an algebraic species R is its formula minus itself
  std::vector<double> diffusion;  ///< C0 * C1 of each species there
  std::vector<double> cross;  ///< coefficient of lap(u_j) in equation i at [i * n + j], j != i; empty if there is none
  std::vector<char> algebraic;                    ///< per species: its R stays 0; empty if all evolve
  std::vector<std::complex<double>> eigenvalues;  ///< of the evolving species at k = 0, largest real part first

  std::optional<double> wavelength;  ///< 2 pi / k where growth(k) has its highest interior maximum, if it has one
  double growth = 0;                 ///< largest real part of sigma: at that wavelength, else over all k
  bool oscillatory = false;          ///< sigma is complex there
  std::optional<double> band_min, band_max;  ///< wave numbers around it that grow; none if it does not grow
};

/// Analyses a model; the steady states are those that Newton's method reaches from some hundred starts. When there is
/// none, `steady_states` and all else stay empty.
Stability analyse(const Model& model);

/// The same about one given steady state, which is the only one in `steady_states`.
Stability analyse_at(const Model& model, const std::vector<double>& steady_state);

/// The eigenvalue of J - k^2 D with the largest real part: growth rate and angular frequency of waves exp(i k x).
/// Algebraic species are eliminated: J - k^2 D is then the Schur complement on the others.
std::complex<double> growth_rate(const Stability& stability, double wave_number);

}  // namespace pelage
