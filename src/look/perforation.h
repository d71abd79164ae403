#pragma once
// Coats with holes.

#include "look/tessellation.h"

namespace pelage {

struct Perforated {
  Tessellation tessellation;
  std::size_t islands = 0;  ///< parts that hung on nothing and were left out
  double island_area = 0;   ///< theirs, as a part of all that was not a hole
};

/// What is left of a tessellation where the paint has holes (print/perforate). Formulas are evaluated on the borders of
/// holes, with all that the samples have, linear between them. Error(Fault::usage), located, where the condition holds
/// nowhere or everywhere.
Perforated with_holes(const Tessellation& tessellation, const Paint& paint);

}  // namespace pelage
