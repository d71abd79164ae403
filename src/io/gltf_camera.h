#pragma once
// The camera of a glTF file.

#include <optional>
#include <string>

#include "pelage/point.h"

namespace pelage {

/// Lengths in metres, y up, as in all glTF.
struct GltfCamera {
  Point position, towards, up;   ///< the directions are unit vectors
  double angle;                  ///< that the picture's height sees, degrees
  std::optional<double> aspect;  ///< of the picture, width over height
};

/// The first camera among the nodes of the file's default scene (without scenes: of all). Error(Fault::input) for a
/// file that cannot be read or has no perspective camera there.
GltfCamera read_gltf_camera(const std::string& path);

}  // namespace pelage
