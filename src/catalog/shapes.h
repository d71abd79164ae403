#pragma once
// Every shape by its name: files, built-in ones, regions and patches.

#include <string>
#include <vector>

#include "pelage/grow.h"

namespace pelage {

/// The patches that are compiled in; as the regions (catalog/regions.h) they are shapes: "builtin:vase?refine=2".
std::vector<std::string> patches_names();

/// Throws as find_shape() does for what can be known without any work: unknown kinds and names, files that are not
/// there.
void check_shape_name(const std::string& path);

/// Whether find_shape() would give a grid; and whether patches.
bool names_grid(const std::string& path);
bool names_atlas(const std::string& path);

}  // namespace pelage
