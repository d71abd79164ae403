#pragma once
// What linear theory says about a uniform state of a model. Lengths and times in model units.

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pelage {

/// Linear stability of the spatially uniform system, with the quantities of the place at their mean (noise and
/// normal() at their mean, uniform() at its midpoint; coordinates, normals, curvatures and attributes at 0) and t = 0.
/// Lengths and times in model units; wave numbers are 2 pi / wavelength.
struct Stability {
  std::vector<std::vector<double>> steady_states;  ///< all that were found, within the bounds of the species
  std::size_t chosen = 0;         ///< the one nearest to the mean initial values; what follows is about it
  std::vector<double> jacobian;   ///< dR_i/du_j at [i * n + j]; for an algebraic species R is its formula minus itself
  std::vector<double> diffusion;  ///< C0 * C1 of each species there
  std::vector<double> cross;   ///< coefficient of lap(u_j) in equation i at [i * n + j], j != i; empty if there is none
  std::vector<double> fluxes;  ///< c of div(c grad u_j) in equation i at [i * n + j], beside `diffusion` and `cross`;
                               ///< empty if there is none
  std::vector<char> algebraic;                    ///< per species: its R stays 0; empty if all evolve
  std::vector<std::complex<double>> eigenvalues;  ///< of the evolving species at k = 0, largest real part first

  std::optional<double> wavelength;  ///< 2 pi / k where growth(k) has its highest interior maximum, if it has one
  double growth = 0;                 ///< largest real part of sigma: at that wavelength, else over all k
  bool oscillatory = false;          ///< sigma is complex there
  std::optional<double> band_min, band_max;  ///< wave numbers around it that grow; none if it does not grow
};

/// The eigenvalue of J - k^2 D with the largest real part: growth rate and angular frequency of waves exp(i k x).
/// Algebraic species are eliminated: J - k^2 D is then the Schur complement on the others.
std::complex<double> growth_rate(const Stability& stability, double wave_number);

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

/// One line: "a Turing pattern: ...".
std::string describe(Regime regime);

/// A condition for diffusion to drive a pattern out of a stable uniform state.
struct Condition {
  std::string text;  ///< with its numbers: "trace of the Jacobian -0.05 < 0"
  bool holds = false;
};

/// Where growth of waves begins or ends when one diffusion varies and the others stay.
struct DiffusionThreshold {
  std::size_t species = 0;
  double diffusion = 0;     ///< the nearest value at which growth changes sign [model length^2 / time]
  bool grows_above = true;  ///< waves grow for larger values, otherwise for smaller ones
};

}  // namespace pelage
