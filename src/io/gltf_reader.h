#pragma once
// glTF 2.0, as .gltf (with its buffers beside it or inside) and .glb.

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// Reads the triangles (also strips and fans) of all meshes of the default scene, in world coordinates; without
/// a scene, of all nodes, and without nodes, of all meshes. Points and lines are left out and reported.
/// Attributes: "color" from COLOR_0 (linear already), "uv" from TEXCOORD_0 (v turned upwards), NAME from _NAME;
/// where a part lacks one, it is 0 (colour: 1). Exporters split vertices where uv or normals jump: the repair
/// merges them again. Images, skins and morph targets are ignored.
/// Throws Error(Fault::input) naming the mesh or accessor, also for compressed meshes.
RawShape read_gltf(std::string_view bytes, const std::string& path);

}  // namespace pelage
