#pragma once
// Grids without folds from folded ones, by a penalty that stays finite at folds and is sharpened until there are none
// (Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free maps in 50 lines of code", 2021).

#include "gridgen/sheet.h"

namespace pelage {

struct Untangled {
  bool unfolded = false;
  int iterations = 0;
};

/// Moves the inner nodes in the plane; the border stays.
Untangled untangle(const Sheet& sheet, std::vector<Point>& nodes);

}  // namespace pelage
