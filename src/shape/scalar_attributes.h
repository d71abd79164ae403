#pragma once
// The attributes of a mesh as formulas name them.

#include <map>
#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Values at the vertices, by the name that attribute(NAME) uses.
using VertexAttributes = std::map<std::string, std::vector<double>>;

/// The vertex attributes of a mesh, each component by itself: "mask", or "color_1", "color_2", "color_3".
VertexAttributes scalar_attributes(const std::vector<Attribute>& attributes);

}  // namespace pelage
