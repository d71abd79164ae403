#pragma once
// The functions phi_k of exponential integrators.

namespace pelage {

/// phi_0 = exp(z), phi_(k+1)(z) = (phi_k(z) - 1/k!) / z, and exp and phi_1 at z/2.
struct Phi {
  double half_exp, half_phi1, exp, phi1, phi2, phi3;
};
Phi phi_functions(double z);

}  // namespace pelage
