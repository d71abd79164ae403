#pragma once
// A surface in charts: discs that are laid into the plane nearly as they are in space.

#include <vector>

#include "pelage/progress.h"
#include "unwrap/chart.h"

namespace pelage {

/// Nearly flat regions are laid out and split where they come out badly; then neighbours become one, seam by seam, as
/// long as what comes out is good. Every chart is flattened, without turned triangles or overlaps. Faces of the file
/// stay whole. Error(Fault::cancelled).
std::vector<Chart> make_charts(const LinkedFaces& faces, const Progress& progress);

}  // namespace pelage
