#pragma once
// Which wavelengths a pattern on a surface is made of.

#include <vector>

#include "discretise/space.h"
#include "pelage/measure.h"

namespace pelage {

/// Of linear elements, from `values` at the vertices. It is Gauss's quadrature of the spectral measure that Lanczos's
/// iteration finds (Golub, Meurant 2010), with (1 + (k/near)^2)^-1 for the operator, which spreads its nodes over the
/// wave numbers around `near` [1 / world units]; all moments of this operator up to twice the number of nodes are
/// exact. Empty for a constant.
Spectrum spectrum(const Space& space, const std::vector<double>& values, double near);

}  // namespace pelage
