#pragma once
// Time steppers. Numerics answer with data: a step that fails says so in its report and leaves the state as it was.

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "linalg/linear_solver.h"
#include "time/linearisation.h"
#include "time/system.h"

namespace pelage {

/// A value that no step may lead to: not finite, or too large.
struct Runaway {
  std::size_t species = 0, unknown = 0;
  double value = 0;
};

struct StepReport {
  bool accepted = false;           ///< the state has advanced
  std::string failure;             ///< why it has not; empty when only the error estimate was too large
  bool refused = false;            ///< the failure is that the stepper cannot grow the system, whatever the step
  std::optional<Runaway> runaway;  ///< where that was a value
  int iterations = 0;              ///< stages, or of the linear solver, all species together
  double bytes = 0;     ///< that these read and wrote, at least: every array once a pass; 0 where not counted
  double residual = 0;  ///< relative, the largest of all species
  int solves = 0;       ///< linear systems
  int indefinite = 0;   ///< of which the matrix was not positive definite
  double solve_seconds = 0;
  double error = 0;   ///< estimated local error relative to the size of the fields; 0 when unknown
  double change = 0;  ///< of the pattern per unit of time: root mean square of du/dt over that of the deviation
                      ///< from the mean, the largest of all species. A growing pattern changes by its growth
                      ///< rate however faint it is; only a finished one comes to rest.
  double minimum = 0, maximum = 0;  ///< over the coefficients of all species
};

struct StepRequest {
  double dt = 0;
  double largest_error = std::numeric_limits<double>::infinity();  ///< reject the step above this estimate
  double solver_tolerance = 1e-10;
  const SolverKind* solver = &jacobi_gradients;  ///< of steppers with StepperKind::solves
  std::int64_t refresh = 1;  ///< of steppers with StepperKind::refreshes: their matrices are made of the fields at
                             ///< every so many steps
};

class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual StepReport step(const System& system, State& state, const StepRequest& request) = 0;
};

/// What the rest of the program knows of a stepper.
struct StepperKind {
  std::string_view name;
  std::string_view alias = {};  ///< an older name, or empty
  std::unique_ptr<Stepper> (*make)() = nullptr;
  SampleRule samples = SampleRule::vertices;       ///< where it evaluates the reaction
  bool adaptive = false;                           ///< reports an error by which the step is chosen; else steps have to
                                                   ///< stay below the limit of linear stability
  bool couples = false;                            ///< grows species that are linked by lap()
  bool holds = false;                              ///< heeds System::held
  bool keeps_rates = false;                        ///< State::past_rates
  Amplification* amplification = amplify_nothing;  ///< of a wave, see time/linearisation.h
  double tolerance = 0;                            ///< of adaptive ones: error per step that pictures do not show
  double jump_tolerance = 0;  ///< the same where rates jump: nodes that a front has just passed count as errors, but
                              ///< only the front is late, by part of a step
  bool any_step = false;      ///< stable at every step: its error estimate alone limits the step
  bool dilutes = false;       ///< of second order where amounts ride along with a surface that grows
  bool lattice = false;       ///< only for systems on a lattice whose species have a Species::tensor
  bool matrix_free = false;   ///< needs no matrices where a lattice and tensors are known
  bool gives_values = false;  ///< heeds System::set_values and Species::held
  bool nodal = false;         ///< only for systems whose unknowns are the values at the samples
  bool symmetric = false;     ///< solves with stiffness matrices, or sums powers of them: they have to be symmetric
  bool solves = false;        ///< heeds StepRequest::solver
  bool refreshes = false;     ///< heeds StepRequest::refresh
  bool splits = false;        ///< only for systems with Reaction::split
};

extern const StepperKind sbdf2;           ///< second-order semi-implicit backward differences, variable step (Ruuth
                                          ///< 1995; Wang, Ruuth 2008)
extern const StepperKind semi_implicit;   ///< semi-implicit Euler, eqs. (14)-(15) of Bajaj, Zhang, Xu 2008: reaction
                                          ///< split as C2(u^n) u^(n+1) + C3(u^n), first order
extern const StepperKind explicit_euler;  ///< forward Euler
extern const StepperKind rkc2;  ///< second-order stabilised explicit Runge-Kutta-Chebyshev, in single precision
                                ///< (Sommeijer, Shampine, Verwer 1997)
extern const StepperKind sign_iteration;  ///< rounds of implicit solves to the steady state of threshold patterns

extern const StepperKind etd;  ///< exponential time differencing of third order (Cox, Matthews 2002): wave by wave on
                               ///< even grids, elsewhere by Chebyshev series

// On even grids, of waves that spread and decay exactly:
extern const StepperKind gaussian_stepper;  ///< convolution with Gaussians (Witkin, Kass 1991, eq. 12), of first order
extern const StepperKind binary_stepper;    ///< convolution of bits (Witkin, Kass 1991, section 5): for threshold pairs

/// Those that come with the program, the default first.
std::span<const StepperKind* const> stepper_kinds();

}  // namespace pelage
