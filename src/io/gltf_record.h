#pragma once
// The record of what made a file (io/record.h) in glTF: asset.extras.pelage.

#include <string>
#include <string_view>

namespace tinygltf {
class Model;
}

namespace pelage {

/// Nothing where the text is empty.
void set_record(tinygltf::Model& model, const std::string& text);

/// The text of the record in the bytes of a .glb or .gltf file; empty where there is none, or no glTF either.
std::string record_in_gltf(std::string_view bytes);

}  // namespace pelage
