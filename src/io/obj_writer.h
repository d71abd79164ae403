#pragma once
// Wavefront OBJ (text).

#include <string>

#include "pelage/polygon_mesh.h"

namespace pelage {

/// The text of an OBJ file: v with the coordinates (read back as the same doubles) and, if the vertices have
/// "color", with red green blue in sRGB 0..1 after them, as Blender, MeshLab, ZBrush and three.js read it;
/// vt from "uv", vn from "normal", both at vertices or corners; o, g, usemtl and s from "object", "group", "material"
/// and "smoothing" of the faces; mtllib. Vertices are never split. Other attributes are left out.
std::string encode_obj(const PolygonMesh& mesh);

}  // namespace pelage
