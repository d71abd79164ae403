#pragma once
// The stepper rkc2 with what tests choose.

#include <memory>

#include "base/instruction_set.h"
#include "time/stepper.h"

namespace pelage {

struct Rkc2Options {
  int sweeps = 1;  ///< of the series for the inverse of the mass
  InstructionSet instructions = best_instruction_set();
};

std::unique_ptr<Stepper> make_rkc2(const Rkc2Options& options = {});

}  // namespace pelage
