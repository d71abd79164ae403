#pragma once
// Grids in volumes: on the faces as on surfaces, within by transfinite interpolation and descent.

#include "gridgen/block.h"
#include "gridgen/generate.h"
#include "gridgen/untangle.h"

namespace pelage {

/// Fills the inner nodes between those on the six faces: linear along all axes less what is counted more than once. May
/// fold.
void fill_between_faces(const Block& block, std::vector<Point>& nodes);

/// As for sheets (gridgen/untangle.h): moves the inner nodes; the faces stay.
Untangled untangle(const Block& block, std::vector<Point>& nodes);

/// For a region with a volume; as generate().
GeneratedGrid generate_volume(const Region& region, const GenerateOptions& options);

}  // namespace pelage
