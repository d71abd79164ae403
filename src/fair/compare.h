#pragma once
// How far one mesh is from another: the measures by which denoising is judged.

#include <optional>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Angles between the normals of equal triangles, in degrees.
struct NormalErrors {
  double mean = 0;   ///< plain mean over the faces
  double sharp = 0;  ///< the same over faces that touch an edge of the reference sharper than 35 degrees; 0 if none
  double quantile95 = 0;
  std::size_t flipped = 0;  ///< faces turned by more than 90 degrees
};

struct Comparison {
  std::optional<NormalErrors> normals;  ///< only if both meshes have the same triangles
  double distance = 0;  ///< area-weighted root mean square distance of the vertices from the reference's surface
  double largest_distance = 0;  ///< both as a fraction of the reference's diagonal
  double volume_change = 0;     ///< of the closed parts, as a fraction; 0 if there is none
};

/// Compares a mesh with a reference. Error(Fault::input) for a mesh without triangles or extent.
Comparison compare(const TriangleMesh& mesh, const TriangleMesh& reference);

}  // namespace pelage
