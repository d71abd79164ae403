#pragma once
// VTK XML PolyData, for ParaView and VTK.

#include <string>

#include "pelage/polygon_mesh.h"

namespace pelage {

/// The bytes of a VTP file: Points (Float32, as three.js reads no other; Float64 where that would move a point by more
/// than 1e-6 of the mesh's size), Polys, and as point and cell data: Normals, RGB or RGBA (UInt8, sRGB, from "color"),
/// TextureCoordinates, and every other attribute under its own name; but for colours with the type of the attribute.
/// Labels of NAME are the field data NAME_labels. Vertices are split where attributes at corners differ.
std::string encode_vtp(const PolygonMesh& mesh);

}  // namespace pelage
