#include "steppers.h"

namespace plain {

RkcCoefficients::RkcCoefficients(int s) : mu(s + 1), nu(s + 1), mu_tilde(s + 1), gamma_tilde(s + 1) {
  const double w0 = 1 + 2.0 / 13 / s / s;
  std::vector<double> t(s + 1), dt(s + 1), ddt(s + 1), b(s + 1);  // Chebyshev's T_j(w0) and its derivatives
  t[0] = 1;
  t[1] = w0;
  dt[1] = 1;
  for (int j = 2; j <= s; ++j) {
    t[j] = 2 * w0 * t[j - 1] - t[j - 2];
    dt[j] = 2 * w0 * dt[j - 1] - dt[j - 2] + 2 * t[j - 1];
    ddt[j] = 2 * w0 * ddt[j - 1] - ddt[j - 2] + 4 * dt[j - 1];
  }
  for (int j = 2; j <= s; ++j) b[j] = ddt[j] / (dt[j] * dt[j]);
  b[0] = b[1] = b[2];
  const double w1 = dt[s] / ddt[s];
  mu_tilde[1] = b[1] * w1;
  for (int j = 2; j <= s; ++j) {
    mu[j] = 2 * b[j] * w0 / b[j - 1];
    nu[j] = -b[j] / b[j - 2];
    mu_tilde[j] = 2 * b[j] * w1 / b[j - 1];
    gamma_tilde[j] = (b[j - 1] * t[j - 1] - 1) * mu_tilde[j];
  }
}

}  // namespace plain
