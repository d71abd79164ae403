#pragma once
// The equations of Bajaj, Zhang, Xu 2008, section 4.2, for functions on a surface that stays where it is.

#include "fair/flow.h"
#include "linalg/sparse.h"

namespace pelage {

/// One step of eq. (21) solves (mass + t stiffness) f^(n+1) = mass f^n for the control values of a function on the Loop
/// limit surface; its tensor (19) is that of the curvatures of the surface.
struct PaperEquations {
  SparseMatrix mass, stiffness;
  double bend = 0;  ///< radians per mean edge beyond which diffusion across is throttled
};

/// Those of the state's surface with all that is left open chosen as in fairing.
PaperEquations paper_equations(const FairState& state);

}  // namespace pelage
