#pragma once
// Stages of the stabilised explicit Runge-Kutta-Chebyshev method of second order: B. P. Sommeijer, L. F. Shampine, J.
// G. Verwer, "RKC: an explicit solver for parabolic PDEs", J. Comput. Appl. Math. 88 (1997).

#include <vector>

namespace pelage {

/// y_j = y_0 + d_j with d_0 = 0, d_1 = rate_1 h f_0 and
///   d_j = mu_j d_(j-1) + nu_j d_(j-2) + rate_j h f(t + time_(j-1) h, y_(j-1)) + first_j h f_0.
struct ChebyshevStage {
  double mu = 0, nu = 0, rate = 0, first = 0;
  double time = 0;  ///< of y_j, in steps
};

/// Stages 0 .. s of the method with s >= 2 stages; entry 0 is all zeros.
std::vector<ChebyshevStage> chebyshev_stages(int s);

/// The least number of stages for eigenvalues in [-`stiffness`, 0] of h df/dy.
int chebyshev_stage_count(double stiffness);

}  // namespace pelage
