#pragma once
// Files of grids: VTK's images (.vti) and structured grids (.vts), and pictures (.png, .jpg, .jpeg, .exr) of sheets.

#include <string>
#include <string_view>
#include <vector>

#include "pelage/grid.h"
#include "shape/finding.h"

namespace pelage {

struct GridFile {
  Grid grid;                      ///< sound (shape/grid.h)
  std::vector<Finding> findings;  ///< what was found in the file and what was done about it
};

/// Whether the name ends as those of files that read_grid takes.
bool is_grid_file(const std::string& path);

/// Error(Fault::input), with the line where the format has lines, for a file that cannot be read, is damaged, or does
/// not hold what it declares: memory is taken only for what is there.
GridFile read_grid(const std::string& path);

/// The same from the bytes of a file of that name.
GridFile read_grid_bytes(std::string_view bytes, const std::string& name);

/// Writes a grid as .vti or .vts, and sheets and lines as .png (their colours alone) or .exr; the file appears whole or
/// not at all. Errors: Fault::usage for another extension and for what the format cannot hold, as a bent grid as .vti;
/// Fault::numerics for a value that is not finite; Fault::output when the file cannot be written.
void write_grid(const Grid& grid, const std::string& path);

/// The extensions of files that read_grid takes, with the dot.
std::vector<std::string> readable_grid_extensions();
/// The extensions that write_grid takes, with the dot.
std::vector<std::string> grid_extensions();

}  // namespace pelage
