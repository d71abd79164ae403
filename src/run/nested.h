#pragma once
// Nested iteration (Witkin, Kass 1991, section 5): a pattern grows on coarse grids first, where there are few nodes and
// steps are long, and is finished on finer ones.

#include "run/run.h"

namespace pelage {

/// Nodes per wavelength below which no coarser grid is taken: waves there have an error of about a tenth.
inline constexpr double least_nodes_per_wavelength = 6;

/// The grid of every second node along every axis; nothing where their number does not allow it, or positions are
/// given.
std::optional<Grid> every_second_node(const Grid& grid);

/// Replaces the initial state of the first stage of a run on an even grid, which has made no step, by what has grown on
/// the grid of every second node to rest or its end, and there likewise; between nodes it is linear. Random fields
/// belong to places, so that it is the same pattern. Returns the number of coarser grids.
/// Error(Fault::cancelled) where `progress` says so.
int grow_nested(Run& run, const Progress& progress = {});

}  // namespace pelage
