#pragma once
// What `pelage verify` prints and the tests assert: measured figures beside the bounds they must keep.

#include <string>
#include <vector>

namespace pelage {

struct Figure {
  std::string what;  ///< what was measured
  double value = 0;
  double bound = 0;
  bool at_least = false;  ///< whether the value must be at least the bound (else at most)
  bool passed() const { return at_least ? value >= bound : value <= bound; }
};

inline Figure at_most(std::string what, double value, double bound) { return {std::move(what), value, bound, false}; }
inline Figure at_least(std::string what, double value, double bound) { return {std::move(what), value, bound, true}; }

/// Basis functions: partition of unity and derivatives, for valences 3 to 12 and on boundaries.
std::vector<Figure> verify_basis();
/// Matrices: area, row sums, symmetry.
std::vector<Figure> verify_matrices();
/// Convergence of -div grad u + u = f on a torus and a sphere, and eigenvalues of the sphere.
std::vector<Figure> verify_convergence();
std::vector<Figure> verify_eigenvalues();
/// Orders of the time steppers.
std::vector<Figure> verify_time_steppers();
/// The Turing system: wavelength of its early growth, and of the finished pattern on three triangulations of a sphere.
std::vector<Figure> verify_early_growth();
std::vector<Figure> verify_size();

}  // namespace pelage
