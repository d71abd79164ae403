#pragma once
// The papers whose figures the program makes again.

#include <vector>

#include "recipe/paper.h"

namespace pelage {

/// Those that are compiled in, by the names of their files.
std::vector<Paper> papers();

}  // namespace pelage
