#pragma once
// The extensions of glTF: which are understood, which do not matter to a surface, which cannot be done without.

#include <vector>

#include "io/gltf_document.h"
#include "shape/finding.h"

namespace pelage {

/// Error(Fault::input) that names the extensions that the file requires and that are unknown. Appends the unknown ones
/// that it only uses.
void check_extensions(const GltfDocument& document, std::vector<Finding>& findings);

}  // namespace pelage
