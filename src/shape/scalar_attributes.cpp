#include "shape/scalar_attributes.h"

namespace pelage {

VertexAttributes scalar_attributes(const std::vector<Attribute>& attributes) {
  VertexAttributes result;
  for (const Attribute& a : attributes) {
    if (a.domain != Domain::vertex) continue;
    const auto components = static_cast<std::size_t>(a.components);
    for (std::size_t c = 0; c < components; ++c) {
      auto& values = result[components == 1 ? a.name : a.name + "_" + std::to_string(c + 1)];
      for (std::size_t i = c; i < a.values.size(); i += components) values.push_back(a.values[i]);
    }
  }
  return result;
}

}  // namespace pelage
