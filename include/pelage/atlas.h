#pragma once
// Patches that are sewn along their edges: a cube blown up to a sphere, a vase with its bottom, a Moebius band.

#include <cstdint>
#include <string>
#include <vector>

#include "pelage/grid.h"

namespace pelage {

/// Sheets that share nodes where their borders meet, in any orientation, any number of them in a corner.
struct Atlas {
  struct Patch {
    std::string name;
    Grid grid;                       ///< of dimension 2, closed along both axes
    std::vector<std::int32_t> node;  ///< per node of the grid: its number among those of the atlas
    bool turned = false;             ///< seen from outside the first axis turns to the second clockwise
  };
  std::vector<Patch> patches;
  std::int32_t nodes = 0;
  bool one_sided = false;  ///< there is no outside: a Moebius band
  std::optional<double> metres_per_unit = {};
};

}  // namespace pelage
