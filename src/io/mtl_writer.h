#pragma once
// Material libraries of OBJ files (MTL).

#include <map>
#include <string>

namespace pelage {

/// The images of a material by what they show: "color", "normal" (in tangent space), "roughness", "metalness",
/// "opacity", "emission"; others it cannot name.
using MtlMaps = std::map<std::string, std::string>;

/// The text of one material of a library, with the statements of the common extension for physically based materials.
/// `emission`: the light of white texels.
std::string mtl_text(const std::string& material, const MtlMaps& maps, double emission);

}  // namespace pelage
