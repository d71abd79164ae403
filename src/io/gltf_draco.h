#pragma once
// Meshes that Draco compressed (KHR_draco_mesh_compression).

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/gltf_document.h"

namespace pelage {

struct DracoMesh {
  std::vector<std::uint32_t> corners;                     ///< three per triangle
  std::map<std::string, std::vector<double>> attributes;  ///< per name in glTF: tuple after tuple, as stored
};

/// The mesh of a primitive that has this extension. `components` gives the width that the file promises for an
/// attribute. Error(Fault::input) that names Draco for data that are damaged, and in builds without it.
DracoMesh unpack_draco(GltfDocument& document, const GltfJson& extension, const std::map<std::string, int>& components,
                       const std::string& label);

}  // namespace pelage
