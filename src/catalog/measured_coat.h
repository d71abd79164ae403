#pragma once
// The pattern in a file, and which of its numbers is measured.

#include <optional>
#include <string>
#include <vector>

#include "pelage/measure.h"

namespace pelage {

/// What a pattern lies on: a cloud has no triangles, a volume is more than they show.
enum class Ground { surface, cloud, volume };
Ground ground_of(const ShapeFile& file);

/// The number of that name at every vertex, or the first without one. Error where there is none; `path`: of the file.
Attribute field_of(const TriangleMesh& mesh, const std::string& name, const std::string& path);

/// `level`: where parts end, see measure_pattern().
PatternMeasures measure_coat(const ShapeFile& file, const Attribute& field, const std::optional<double>& level);

/// [length unit] of a wave number [radians / length unit].
double wavelength_of(double wave_number);

}  // namespace pelage
