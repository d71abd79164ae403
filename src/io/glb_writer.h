#pragma once
// glTF 2.0, binary (GLB): a node with a mesh for every object.

#include <string>
#include <vector>

#include "pelage/texture_maps.h"
#include "pelage/triangle_mesh.h"
#include "pelage/up_axis.h"

namespace pelage {

struct GlbOptions {
  std::string name = "mesh";               ///< of mesh and node; in UTF-8, with U+FFFD for other bytes
  UpAxis up = UpAxis::y;                   ///< of the mesh; in the file y points up, as glTF prescribes
  std::vector<TextureMaps> textures = {};  ///< of all materials, or one for each, laid on the mesh by its "uv"
  bool repeat = false;                     ///< beyond their borders
};

/// The bytes of a GLB file. Where z points up, (x, y, z) becomes (x, z, -y), as do normals, tangents and directions.
/// Per vertex, where the mesh has them:
///   POSITION    float; far from the origin, where floats would lose more than a millionth of the extent, they count
///               from the translation of the node. Where the unit of the mesh is known and no metre, the scale of the
///               node turns them into metres, which glTF prescribes
///   NORMAL      float, scaled to unit length (0 1 0 where it is zero)
///   COLOR_0     float, linear, clamped to [0, 1]; three or four components as in "color"; COLOR_1 from "color1". With
///               textures there is none: viewers multiply them
///   TEXCOORD_0  float, with v flipped: glTF counts it downwards; TEXCOORD_1 from "uv1"
///   _NAME       float, any other attribute of up to four components; letters in upper case, characters
///               other than letters, digits and _ become _ (wider ones are split into _NAME_0 ...)
///   TANGENT     float, where there is a normal map: corner_tangents() of the mesh, which needs a "normal"
/// Vertices are split where attributes at corners differ. Where faces have an "object", every object is a node and a
/// mesh of its own and its name; where they have a "material", a mesh has a part for each. The material is what
/// the mesh says of pelage/channel.h, or else a plain dielectric (metallic 0, roughness 0.8: short hair with a broad,
/// faint highlight); it is double-sided if the surface is not closed. Error(Fault::output) above 4 GiB.
std::string encode_glb(const TriangleMesh& mesh, const GlbOptions& options = {});

}  // namespace pelage
