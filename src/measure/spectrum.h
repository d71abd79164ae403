#pragma once
// Which wavelengths a pattern on a surface is made of.

#include <vector>

#include "discretise/space.h"

namespace pelage {

/// How the variance of a function is shared out among the eigenfunctions of the Laplace-Beltrami operator,
/// -laplacian phi = k^2 phi; on a closed plane these are waves of wave number k.
struct Spectrum {
  std::vector<double> wave_number;  ///< k, ascending [1 / world units]
  std::vector<double> share;        ///< of the variance there; their sum is 1

  bool empty() const { return wave_number.empty(); }
  /// The wave number below which a share of the variance lies, linear between the middles of steps. Of one that is not
  /// empty.
  double quantile(double share) const;
  /// Variance per unit of ln k at these wave numbers, each share smoothed by a Gaussian of ln k.
  std::vector<double> density(const std::vector<double>& at) const;
  /// Where this density is largest.
  double peak() const;
};

/// Of linear elements, from `values` at the vertices. It is Gauss's quadrature of the spectral measure that Lanczos's
/// iteration finds (Golub, Meurant 2010), with (1 + (k/near)^2)^-1 for the operator, which spreads its nodes over the
/// wave numbers around `near` [1 / world units]; all moments of this operator up to twice the number of nodes are
/// exact. Empty for a constant.
Spectrum spectrum(const Space& space, const std::vector<double>& values, double near);

}  // namespace pelage
