#pragma once
// Wavefront OBJ (text).

#include <string>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The text of an OBJ file: v with the coordinates (read back as the same doubles) and, if the mesh has
/// "color", with red green blue in sRGB 0..1 after them, as Blender, MeshLab, ZBrush and three.js read it;
/// vt from "uv", vn from "normal". Both may sit at vertices or corners; vertices are never split.
/// Other attributes are left out.
std::string encode_obj(const TriangleMesh& mesh);

}  // namespace pelage
