#pragma once
// Pictures of grids: their lines, as in books.

#include <string>
#include <vector>

#include "pelage/grid.h"
#include "pelage/image.h"

namespace pelage {

/// The lines of a grid of one or two axes, and of the border of one of three, over white; its border is drawn stronger.
/// Grids that do not lie in a plane of constant z are seen from above at a slant. `size`: the longer side [pixels].
Image grid_lines_picture(const Grid& grid, int size);

struct NamedGrid {
  std::string name;
  Grid grid;
};

/// Such pictures in rows of `columns`, each with its name in a square of `tile` pixels.
Image grid_lines_sheet(const std::vector<NamedGrid>& grids, int columns, int tile);

}  // namespace pelage
