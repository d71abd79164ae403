#pragma once
// VTK XML PolyData, for ParaView and VTK. The arrays are uncompressed base64 within the XML text, because
// ParaView 5.11 fails on the appended form.

#include <string>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The bytes of a VTP file: Points (Float32: three.js reads no other; PLY and OBJ keep all digits),
/// Polys, and as point data: Normals (Float32 x 3), RGB (UInt8 x 3, sRGB, from "color"), TextureCoordinates
/// (Float32 x 2), and every other attribute as Float32 under its own name.
/// Vertices are split where attributes at corners differ.
std::string encode_vtp(const TriangleMesh& mesh);

/// Standard base64 with padding (RFC 4648, section 4), appended to `text`.
void append_base64(std::string& text, const std::string& bytes);

}  // namespace pelage
