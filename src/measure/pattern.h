#pragma once
// What a pattern on a surface is like, in numbers.

#include <optional>
#include <vector>

#include "pelage/measure.h"

namespace pelage {

/// Halfway between the lowest and the highest half percent of the values, of which there are some.
double middle_level(std::vector<double> values);

/// Of a function that is linear on the triangles, with one value per vertex. Default level: middle_level.
/// Error(Fault::input) for meshes without area, or that are no manifold.
PatternMeasures measure_pattern(const TriangleMesh& mesh, const std::vector<double>& values,
                                const std::optional<double>& level = {});

}  // namespace pelage
