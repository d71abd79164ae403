#pragma once
// What the readers of the formats hand on: polygons as the file has them, not yet checked.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pelage/up_axis.h"
#include "shape/finding.h"
#include "shape/triangulate.h"

namespace pelage {

/// A reader leaves vertex numbers out of range and coordinates that are not finite to the checks, which
/// name the element; the lines, where the format has lines, tell where in the file it stands.
struct RawShape {
  PolygonMesh mesh;
  std::vector<int> vertex_lines;  ///< per vertex: line of the file, from 1; empty for binary files
  std::vector<int> face_lines;    ///< per face: likewise
  std::vector<Finding> findings;
  UpAxis up = UpAxis::y;  ///< as the file says
  std::string name;       ///< of the only object, or empty
  std::optional<double> metres_per_unit = {};
};

}  // namespace pelage
