#pragma once
// Buffer views that meshoptimizer compressed (EXT_meshopt_compression).

#include <string>

#include "io/gltf_document.h"

namespace pelage {

/// The name of the extension by which a buffer view is compressed, or nullptr.
const char* meshopt_extension(const GltfDocument& document, const GltfJson& view);

/// The bytes of that buffer view. Error(Fault::input) that names the extension for data that are damaged, and in builds
/// without meshoptimizer.
std::string unpack_meshopt(GltfDocument& document, const GltfJson& view, const char* extension,
                           const std::string& label);

}  // namespace pelage
