#pragma once
// The way in: a file (or the name of a built-in shape) -> a checked and repaired triangle mesh.

#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/finding.h"

namespace pelage {

struct ShapeFile {
  TriangleMesh mesh;              ///< as repair() leaves it
  std::vector<Finding> findings;  ///< what was found in the file and what was done about it
};

/// Reads OBJ, PLY, STL, OFF, glTF and GLB (the extension decides; capitals count as small letters), cuts polygons
/// into triangles, checks and repairs. "builtin:NAME?parameters" makes a built-in shape (shape/generators.h).
/// Throws Error(Fault::input): "FILE:LINE: face 1204: ..." with the line where the format has lines; vertices
/// and faces are counted from 0 in the order of the file.
ShapeFile read_shape(const std::string& path_or_builtin);

/// The extensions that read_shape knows, with the dot: ".obj", ...
std::vector<std::string> readable_extensions();

}  // namespace pelage
