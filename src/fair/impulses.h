#pragma once
// Noise that sits on some of the vertices only: the others are found and go back to where they were.

#include <vector>

#include "fair/flow.h"

namespace pelage {

/// Two normal distributions about 0, of which values come by chance.
struct TwoNormals {
  double quiet = 0, loud = 0;  ///< standard deviations, the smaller one first
  double share = 0;            ///< of the values from the first
};

/// The likeliest ones (expectation and maximisation); the first is at least a small share of the second.
TwoNormals fit_two_normals(const std::vector<double>& values);

/// After some steps of a method from the points `from`: whether the vertices have gone two kinds of ways, far ones and
/// hardly any, and those of the second kind have no noise. If so, these are put back, and the others are where the
/// method brings them between them; the number of those that were put back is returned. Else nothing moves.
std::size_t settle_impulses(FairState& state, const std::vector<Point>& from, FairMethod& method, FairReport& report);

}  // namespace pelage
