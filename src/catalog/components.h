#pragma once
// The methods, steppers and solvers that recipes can name.

#include <vector>

#include "discretise/method.h"
#include "time/stepper.h"

namespace pelage {

/// Those of the program by default; others may be added.
struct Components {
  std::vector<const Method*> methods = {pelage::methods().begin(), pelage::methods().end()};
  std::vector<const StepperKind*> steppers = {stepper_kinds().begin(), stepper_kinds().end()};
  std::vector<const SolverKind*> solvers = {solver_kinds().begin(), solver_kinds().end()};
};

}  // namespace pelage
