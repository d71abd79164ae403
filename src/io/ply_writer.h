#pragma once
// PLY (binary, little-endian).

#include <string>

#include "pelage/polygon_mesh.h"

namespace pelage {

/// The bytes of a PLY file. Per vertex, where the mesh has them:
///   x y z               float; double where that would move a point by more than 1e-6 of the mesh's size, or where
///                       the points are double and no floats
///   nx ny nz            "normal"
///   red green blue      uchar, sRGB, "color" (and alpha, linear, from a fourth component)
///   s t                 "uv": the names that Blender and three.js read
///   NAME_red ...        another colour: "input_color", "color1"
///   NAME or NAME_1 ...  any other attribute; blanks become _, and a name that means something else to readers gets
///                       a _ at its end: u_, v_, x_
/// each with the type of the attribute, all colours as uchar (sRGB). Faces: property list uchar int vertex_indices; the
/// same properties per face but for s t; per corner lists: texcoord for "uv", NAME for others. Labels are comments:
/// "label material 0 Fur".
std::string encode_ply(const PolygonMesh& mesh);

/// The same with vertices split where attributes at corners differ, because few programs read lists.
std::string encode_ply(const TriangleMesh& mesh);

/// Whether points in 32-bit floats lie within 1e-6 of the mesh's size of where they are: rounding moves points of a
/// shape near the origin by less than 1e-7. Programs draw with floats, and three.js refuses doubles in PLY.
bool floats_suffice(const std::vector<Point>& points);

}  // namespace pelage
