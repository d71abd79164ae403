#pragma once
// 3MF, the format of 3D printing, with the colour of every vertex (core specification 1.3, materials extension 1.2).

#include <string>

#include "pelage/triangle_mesh.h"
#include "pelage/up_axis.h"

namespace pelage {

/// One object, which stands on the plate with its `up` axis upright. Coordinates are those of the mesh where 3MF has
/// its unit (micrometres, millimetres, centimetres, inches, feet, metres), else millimetres, also where nobody knows.
/// Colours are "color", of vertices, corners or faces, with eight bits a channel.
std::string encode_three_mf(const TriangleMesh& mesh, const std::string& name, UpAxis up);

}  // namespace pelage
