#pragma once
// What a pattern on nodes without triangles is like, in numbers: in a volume, or on a cloud of points.

#include <optional>
#include <vector>

#include "discretise/space.h"
#include "measure/pattern.h"

namespace pelage {

/// Of a function with these values at the nodes, each of which stands for its weight in the mass: area, or volume where
/// `dimension` is 3. Nodes belong to one part where the stiffness couples them. `spacing` in a volume is that of the
/// closest packing, (2^(1/2) volume / parts)^(1/3), and diameters are those of balls. What needs lines and triangles
/// stays 0 or empty: borders, widths, directions, defects, neighbours of spots. Default level as measure_pattern.
/// Error(Fault::input) for nodes without weight.
PatternMeasures measure_nodes(const Space& space, int dimension, const std::vector<double>& values,
                              const std::optional<double>& level = {});

}  // namespace pelage
