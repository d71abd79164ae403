#pragma once
// Functions of operators by series of Chebyshev polynomials: f(B) v for a B whose eigenvalues are real and lie between
// 0 and a radius, by products with B alone (Tal-Ezer, Kosloff 1984).

#include <span>
#include <vector>

#include "time/diffusion_operator.h"

namespace pelage {

/// The coefficients of T_k(2 x / end - 1) in the interpolant of a function on [0, end].
using ChebyshevSeries = std::vector<double>;

/// The points of [0, end] at which functions are interpolated that are as smooth as exp(-x), to rounding.
std::vector<double> chebyshev_points(double end);
/// From the values at these points.
ChebyshevSeries chebyshev_series(const std::vector<double>& values);

/// A series, and the sum to which its f(B) v is added.
struct SeriesSum {
  const ChebyshevSeries* series;
  Vector* sum;
};

/// Adds f(B) v for all of these series, which are cut off where what is left is less than `tolerance` in lengths of B.
/// Returns the number of products with B; or -1, with the sums spoilt, where v grows in a way that tells of an
/// eigenvalue beyond the radius of B.
int add_series(const DiffusionOperator& b, const Vector& v, std::span<const SeriesSum> sums, double tolerance);

}  // namespace pelage
