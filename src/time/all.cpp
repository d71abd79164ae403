#include "time/stepper.h"

namespace pelage {

std::span<const StepperKind* const> stepper_kinds() {
  static constexpr const StepperKind* kinds[] = {&rkc2,           &sbdf2, &semi_implicit,    &explicit_euler,
                                                 &sign_iteration, &etd,   &gaussian_stepper, &binary_stepper};
  return kinds;
}

}  // namespace pelage
