#pragma once
// Colours of files -> linear light.

#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/finding.h"

namespace pelage {

/// The attribute "color" from tuples of sRGB values with 3 or 4 components (the fourth, alpha, is linear). Values of 8
/// and 16 bits count to 255 and 65535; others to 1, or to 255 if one of them exceeds 1, which is noted unless all are
/// whole.
Attribute linear_color(std::vector<double> values, int components, std::vector<Finding>& findings,
                       NumberType type = NumberType::float32, Domain domain = Domain::vertex);

/// The number that stands for 1 in colours of that type: 255, 65535, or 1 where the values tell.
double full_scale(NumberType type);

/// Leaves out an alpha that is 1 everywhere.
void drop_opaque_alpha(Attribute& color);

}  // namespace pelage
