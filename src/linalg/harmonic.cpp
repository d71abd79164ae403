#include "linalg/harmonic.h"

#include "pelage/error.h"

namespace pelage {

HarmonicFunctions::HarmonicFunctions(SharedMatrix stiffness, Held held)
    : stiffness_(std::move(stiffness)), held_(std::move(held)), preconditioner_(diagonal(*stiffness_)) {}

void HarmonicFunctions::complete(Vector& u, double tolerance) const {
  constexpr int most_iterations = 10000;
  ConjugateGradientWork<Vector> work;
  const Vector nothing = Vector::Zero(u.size());
  if (!conjugate_gradient(*stiffness_, preconditioner_, nothing, u, &held_, {tolerance, most_iterations}, work)
           .converged)
    throw Error(Fault::numerics, "the harmonic function between given values was not found");
}

}  // namespace pelage
