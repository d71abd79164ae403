#pragma once
// Colours of files -> linear light.

#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The attribute "color" from tuples of sRGB values with 3 or 4 components (the fourth, alpha, is linear).
/// Values count from 0 to 1, or to 255 if one of them exceeds 1. An alpha that is 1 everywhere is left out.
Attribute linear_color(std::vector<double> values, int components);

}  // namespace pelage
