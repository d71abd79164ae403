#pragma once
// Flattened charts laid side by side in the unit square.

#include "pelage/progress.h"
#include "unwrap/chart.h"

namespace pelage {

/// Turns, scales and shifts the uv of all charts, all at one scale and as large as is found to fit: on a raster, the
/// largest charts first, each at the lowest free place in one of four turns. Two charts are nowhere nearer to each
/// other than `margin` texels of an image `resolution` texels wide, and half of that to the border of the square; the
/// same across the borders of an image that repeats. Returns the length in uv of a unit of the points. uv are multiples
/// of 2^-24, which files hold exactly. Error(Fault::usage) where the margins alone take up all the room;
/// Error(Fault::cancelled).
double pack(std::vector<Chart>& charts, int resolution, double margin, const Progress& progress = {});

}  // namespace pelage
