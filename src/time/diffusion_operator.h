#pragma once
// The diffusion of a species as a function of its coefficients, on any space.

#include "time/system.h"

namespace pelage {

/// B u = D P K u with P for the inverse of the mass M. Where unknowns are values at the nodes P is its series
/// (I + E) L^-1, E = I - L^-1 M, L the row sums of M, cut off after one term as in rkc2: an error of fourth order of
/// the edge, and as 1'L E = 0 no amount moves. Elsewhere M is solved with. The eigenvalues of B are real and not
/// negative, where K and M are symmetric and M is definite.
class DiffusionOperator {
 public:
  /// Takes the species over; quick where its matrices are the same objects as before.
  void update(const System& system, std::size_t species);
  /// y = B x; 0 where unknowns are held.
  void apply(const Vector& x, Vector& y) const;
  /// y = P b of a load, 0 where unknowns are held.
  void over_mass(const Vector& load, Vector& y) const;
  /// Nearly the one in which B is symmetric: the root of the integral of the square.
  double length(const Vector& x) const;
  /// The largest eigenvalue of B, and a little more [1/time].
  double radius() const { return diffusion_ * radius_of_one_; }
  /// Raises it, where it turns out to be too small.
  void raise_radius() { radius_of_one_ *= 1.25; }

 private:
  double largest_eigenvalue() const;

  double diffusion_ = 0;
  SharedMatrix mass_, stiffness_;
  std::shared_ptr<const Held> held_;
  std::shared_ptr<const Sampling> sampling_;
  bool nodal_ = true, diagonal_ = true;
  Vector sums_, inverse_sums_;  ///< L and its inverse
  double radius_of_one_ = 0;
  mutable Vector product_, load_;
};

}  // namespace pelage
