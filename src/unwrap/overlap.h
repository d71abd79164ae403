#pragma once
// Whether a flattened disc lies on itself.

#include "unwrap/chart.h"

namespace pelage {

/// Whether the border of a flattened disc crosses or touches itself. If not, and no triangle is turned over, no two of
/// its triangles overlap: the map covers every place as often as the border winds around it, which is once.
bool border_meets_itself(const Chart& chart);

}  // namespace pelage
