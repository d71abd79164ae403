#pragma once
// The built-in grids.

#include <string>
#include <string_view>
#include <vector>

#include "pelage/grid.h"

namespace pelage {

/// "line", "tile", "sheet", "box".
std::vector<std::string> builtin_grid_names();

/// The counts of "512x256" along so many axes, of which one number stands for all; nothing for other texts.
std::optional<std::array<std::int32_t, 3>> parse_counts(const std::string& text, int axes);

/// Does the text name a built-in grid: "builtin:tile", "builtin:tile?n=512"?
bool is_builtin_grid(std::string_view spec);

/// The even grid of "builtin:NAME?n=COUNTS&periodic=AXES" with COUNTS like 512, 512x256 or 96x96x64 nodes (one number
/// stands for all axes) and AXES like x or xy, or none. Nodes are 1 / (largest count) apart, the first at 0.
///   line   60 nodes, closed
///   tile   512x512, periodic along both axes: its pictures repeat without a seam
///   sheet  512x512, closed
///   box    64x64x64, closed
/// Error(Fault::usage) for unknown names and parameters, counts below 2 (3 on periodic axes), and more than 100 million
/// nodes.
Grid builtin_grid(const std::string& spec);
/// Throws as builtin_grid() does, and makes nothing.
void check_builtin_grid(const std::string& spec);

}  // namespace pelage
