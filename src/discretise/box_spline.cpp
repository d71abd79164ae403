#include "discretise/box_spline.h"

namespace pelage {

namespace {

constexpr std::size_t monomials = 15;

/// Exponents of u, v, w (u = 1 - v - w) of the monomials of degree four, in the order of the columns below.
constexpr int exponents[monomials][3] = {
    {4, 0, 0}, {3, 1, 0}, {3, 0, 1}, {2, 2, 0}, {2, 1, 1}, {2, 0, 2}, {1, 3, 0}, {1, 2, 1},
    {1, 1, 2}, {1, 0, 3}, {0, 4, 0}, {0, 3, 1}, {0, 2, 2}, {0, 1, 3}, {0, 0, 4},
};

// clang-format off
/// Twelve times the coefficients of the basis functions (Stam 1998).
constexpr double coefficients[regular_points][monomials] = {
    // u4 u3v u3w u2v2 u2vw u2w2 uv3 uv2w uvw2 uw3 v4 v3w v2w2 vw3 w4
    {  6,  24, 24,  24,  60,  24,  8,  36,  36,  8,  1,  6, 12,   6,  1},  // a
    {  1,   8,  6,  24,  36,  12, 24,  60,  36,  6,  6, 24, 24,   8,  1},  // b
    {  1,   6,  8,  12,  36,  24,  6,  36,  60, 24,  1,  8, 24,  24,  6},  // c
    {  1,   6,  2,  12,   6,   0,  6,   6,   0,  0,  1,  2,  0,   0,  0},  // r0, across ab
    {  0,   0,  0,   0,   0,   0,  2,   0,   0,  0,  1,  0,  0,   0,  0},  // r1
    {  0,   0,  0,   0,   0,   0,  0,   0,   0,  0,  1,  2,  0,   0,  0},  // r2
    {  0,   0,  0,   0,   0,   0,  2,   6,   6,  2,  1,  6, 12,   6,  1},  // r3, across bc
    {  0,   0,  0,   0,   0,   0,  0,   0,   0,  0,  0,  0,  0,   2,  1},  // r4
    {  0,   0,  0,   0,   0,   0,  0,   0,   0,  2,  0,  0,  0,   0,  1},  // r5
    {  1,   2,  6,   0,   6,  12,  0,   0,   6,  6,  0,  0,  0,   2,  1},  // r6, across ca
    {  1,   0,  2,   0,   0,   0,  0,   0,   0,  0,  0,  0,  0,   0,  0},  // r7
    {  1,   2,  0,   0,   0,   0,  0,   0,   0,  0,  0,  0,  0,   0,  0},  // r8
};
// clang-format on

/// d-th derivative of x^n, from the table of powers of x.
double power_derivative(const double* power, int n, int d) {
  if (d > n) return 0;
  double factor = 1;
  for (int i = 0; i < d; ++i) factor *= n - i;
  return factor * power[n - d];
}

/// The mixed derivative d^(i+j+k) / du^i dv^j dw^k of one monomial, u, v, w taken as independent.
double monomial(const double (&power)[3][5], std::size_t m, int i, int j, int k) {
  return power_derivative(power[0], exponents[m][0], i) * power_derivative(power[1], exponents[m][1], j) *
         power_derivative(power[2], exponents[m][2], k);
}

}  // namespace

BoxSplineJet box_spline(double v, double w) {
  const double x[3] = {1 - v - w, v, w};
  double power[3][5];
  for (int d = 0; d < 3; ++d) {
    power[d][0] = 1;
    for (int n = 1; n < 5; ++n) power[d][n] = power[d][n - 1] * x[d];
  }
  BoxSplineJet jet{};
  for (std::size_t m = 0; m < monomials; ++m) {
    auto p = [&](int i, int j, int k) { return monomial(power, m, i, j, k); };
    // u depends on v and w: d/dv = d_v - d_u and d/dw = d_w - d_u.
    const double derivative[jet_size] = {
        p(0, 0, 0),
        p(0, 1, 0) - p(1, 0, 0),
        p(0, 0, 1) - p(1, 0, 0),
        p(0, 2, 0) - 2 * p(1, 1, 0) + p(2, 0, 0),
        p(0, 1, 1) - p(1, 1, 0) - p(1, 0, 1) + p(2, 0, 0),
        p(0, 0, 2) - 2 * p(1, 0, 1) + p(2, 0, 0),
    };
    for (std::size_t d = 0; d < jet_size; ++d)
      for (std::size_t i = 0; i < regular_points; ++i) jet[d][i] += coefficients[i][m] / 12 * derivative[d];
  }
  return jet;
}

}  // namespace pelage
