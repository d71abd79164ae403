#pragma once
// PLY (binary, little-endian).

#include <string>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The bytes of a PLY file. Per vertex, where the mesh has them:
///   x y z               float; double where that would move a point by more than 1e-6 of the mesh's size
///   nx ny nz            float, "normal"
///   red green blue      uchar, sRGB, "color" (and alpha, linear, from a fourth component)
///   s t                 float, "uv": the names that Blender and three.js read
///   NAME or NAME_0 ...  float, any other attribute; characters other than letters, digits and _ become _, and
///                       a name that means something else to readers gets a _ at its end: u_, v_, x_
/// Vertices are split where attributes at corners differ. Faces: property list uchar int vertex_indices.
std::string encode_ply(const TriangleMesh& mesh);

}  // namespace pelage
