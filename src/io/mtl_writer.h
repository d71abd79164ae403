#pragma once
// Material libraries of OBJ files (MTL).

#include <string>

namespace pelage {

/// The text of a library with one material, whose colour is that of an image.
std::string mtl_text(const std::string& material, const std::string& image);

}  // namespace pelage
