#pragma once
// GLB files made small: quantised (KHR_mesh_quantization) and packed by meshoptimizer (EXT_meshopt_compression).

#include <string>

namespace pelage {

/// The same file, smaller; `glb` as encode_glb() gives it. Triangles and vertices change their order. Positions and
/// texture coordinates within [0, 1] are kept to 1/65535 of their extent, colours to 1/65535, normals and tangents to
/// 0.05 degrees, everything else to 15 bits of its larger components; images stay as they are.
/// Error(Fault::usage) in builds without meshoptimizer.
std::string compress_glb(const std::string& glb);

}  // namespace pelage
