#pragma once
// The base colour image of a glTF file.

#include <string>
#include <string_view>

namespace pelage {

/// The bytes of the only image that materials of the file have as base colour. Error(Fault::input) if there is none or
/// more than one.
std::string gltf_base_image(std::string_view bytes, const std::string& path);

}  // namespace pelage
