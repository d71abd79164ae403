#pragma once
// Shapes for what takes polygons that do not fit together.

#include "input_unit.h"
#include "io/read_shape.h"

namespace pelage {

/// As read_shape(); polygons that it refuses come as they are, with the reason among the findings. `who` takes them.
inline ShapeFile read_soup(const std::string& path, const std::optional<double>& metres_per_unit,
                           const std::string& who) {
  try {
    return read_shape(path, metres_per_unit);
  } catch (const Error& refusal) {
    if (refusal.fault() != Fault::input || is_grid_shape(path)) throw;
    ShapeFile file;
    try {
      file = read_polygons(path);
    } catch (const Error&) {
      throw refusal;
    }
    if (metres_per_unit) file.mesh.metres_per_unit = metres_per_unit;
    file.findings.push_back(
        {"soup", std::string(refusal.what()) + "; " + who + " the polygons as they are", 0, 0, false});
    return file;
  }
}

inline ShapeFile read_for_cells(const std::string& path, const std::optional<double>& metres_per_unit) {
  return read_soup(path, metres_per_unit, "cells take");
}

}  // namespace pelage
