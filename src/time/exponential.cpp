#include "time/exponential.h"

#include <cmath>

namespace pelage {

namespace {

/// Below, the recursion loses digits: phi_3 divides by the third power. The series is then as good as the numbers.
constexpr double small = 1;
constexpr int terms = 16;

/// The sum of z^j / (j + 3)!.
double phi3_series(double z) {
  double sum = 0;
  for (int j = terms; j > 0; --j) sum = (sum + 1) * z / (j + 3);
  return (sum + 1) / 6;
}

}  // namespace

Phi phi_functions(double z) {
  Phi p{};
  p.half_exp = std::exp(z / 2);
  if (std::abs(z) < small) {
    p.phi3 = phi3_series(z);
    p.phi2 = 0.5 + z * p.phi3;
    p.phi1 = 1 + z * p.phi2;
    p.exp = 1 + z * p.phi1;
    p.half_phi1 = 2 * p.phi1 / (p.half_exp + 1);
  } else {
    p.exp = p.half_exp * p.half_exp;
    p.half_phi1 = (p.half_exp - 1) / (z / 2);
    p.phi1 = p.half_phi1 * (p.half_exp + 1) / 2;
    p.phi2 = (p.phi1 - 1) / z;
    p.phi3 = (p.phi2 - 0.5) / z;
  }
  return p;
}

}  // namespace pelage
