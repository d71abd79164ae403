#pragma once
// How large a step each scheme stands, by linear analysis at the steady state.

#include "react/stability.h"
#include "time/stepper.h"

namespace pelage {

/// The largest step [model time] for which no wave number k, 0 <= k^2 <= largest_k2 [1 / model length^2], is amplified
/// faster than the fastest growth of the equations themselves. For the Turing system and semi-implicit Euler:
/// 1/(28 s), reached at k = 0. Infinite when no such step was found, or when the model has no steady state.
double largest_stable_step(const Model& model, const StepperKind& stepper, double largest_k2);
/// The same with what analyse() says of the model.
double largest_stable_step(const Model& model, const Stability& stability, const StepperKind& stepper,
                           double largest_k2);

}  // namespace pelage
