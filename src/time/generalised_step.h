#pragma once
// One semi-implicit step of the generalised PDE (2) of Bajaj, Zhang, Xu 2008, for scalars and vectors:
//   du/dt = C0 div(C1 grad u) + C2 u + C3,
//   (M + dt L) u^(n+1) = M u^n + dt F                                                      (8)
//   M = (phi / C0, phi),  L = (C1 grad phi, grad phi) - (C2 phi / C0, phi),  F = (C3 / C0, phi)   (9)-(11)

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "discretise/sampling.h"
#include "time/stepper.h"

namespace pelage {

/// Coefficients at the quadrature points of the discretisation, frozen for one step. Empty arrays stand for C0 = C1 = 1
/// and C2 = C3 = 0.
struct GeneralisedPde {
  double c0_constant = 1;         ///< used when `c0` is empty; may be 0: nothing diffuses
  std::vector<double> c0;         ///< positive
  std::vector<double> c1;         ///< scalar; or
  std::vector<Tensor> c1_tensor;  ///< symmetric, of which the tangential part acts
  std::vector<double> c2;
  Eigen::MatrixXd c3;  ///< quadrature points x components of u
};

/// u: unknowns x components (one matrix serves all components). Replaced by the result unless the report tells of a
/// failure. `sampling` is quadrature_sampling() of the same control points. Error(Fault::usage) when a varying C0 is
/// not positive: the weak form divides by it.
StepReport generalised_step(const Assembler& assembler, const std::vector<Point>& control, const Sampling& sampling,
                            const GeneralisedPde& pde, double dt, Eigen::MatrixXd& u, double solver_tolerance = 1e-10);

}  // namespace pelage
