#pragma once
// The regions for grids: those compiled in from regions/*.toml, and files of the user.

#include <string>
#include <vector>

#include "gridgen/generate.h"

namespace pelage {

/// Sorted.
std::vector<std::string> region_names();

/// The text of a built-in region. Error(usage) for an unknown name.
std::string region_text(const std::string& name);

/// A built-in region by its name, or the path of a file ending in .toml. Error(usage) for an unknown name, Error(input)
/// for a file that cannot be read, Error(usage) with file, line and column for a fault in it.
Region load_region(const std::string& name_or_path);

}  // namespace pelage
