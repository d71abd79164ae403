#pragma once
// glTF 2.0, as .gltf (with its buffers beside it or inside) and .glb.

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// Reads the triangles (also strips and fans) of all meshes of the default scene as viewers show them before anything
/// moves, in world coordinates: morph targets at their default weights, skins in their rest pose, all instances
/// (EXT_mesh_gpu_instancing). Without a scene all nodes are shown, without nodes all meshes. Compressed meshes are
/// unpacked where the build has the libraries (Draco, meshoptimizer).
/// Attributes: "color" from COLOR_0 (linear already) or, where no part has it, the base colours of the materials; "uv"
/// is the TEXCOORD of the base colour's texture with its transform (v turned upwards); further ones are "color1",
/// "uv1", ...; NAME is from _NAME. Where a part lacks one, it is 0 (colour: 1). Exporters split vertices where uv or
/// normals jump: the repair merges them again. The findings name what is left out.
/// Throws Error(Fault::input) naming the mesh or accessor, and the extensions that a file requires and that are
/// unknown.
RawShape read_gltf(std::string_view bytes, const std::string& path);

}  // namespace pelage
