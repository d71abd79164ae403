#pragma once
// glTF 2.0, binary (GLB): one mesh, one node, one material.

#include <string>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The bytes of a GLB file. Per vertex, where the mesh has them:
///   POSITION    float; coordinates as they are: glTF's y points up, and a mesh with another axis up
///               lies down in viewers as it does in its own file
///   NORMAL      float, scaled to unit length (0 1 0 where it is zero)
///   COLOR_0     float, linear, clamped to [0, 1]; three or four components as in "color"
///   TEXCOORD_0  float, with v flipped: glTF counts it downwards
///   _NAME       float, any other attribute of up to four components; letters in upper case, characters
///               other than letters, digits and _ become _ (wider ones are split into _NAME_0 ...)
/// Vertices are split where attributes at corners differ. The material is a plain dielectric (metallic 0,
/// roughness 0.8), double-sided if the surface is not closed. Error(Fault::output) above 4 GiB.
std::string encode_glb(const TriangleMesh& mesh);

}  // namespace pelage
