#include "pelage/triangle_mesh.h"

#include <algorithm>
#include <utility>

namespace pelage {

const Attribute* TriangleMesh::find(std::string_view name) const {
  auto it = std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == name; });
  return it == attributes.end() ? nullptr : &*it;
}

Attribute* TriangleMesh::find(std::string_view name) { return const_cast<Attribute*>(std::as_const(*this).find(name)); }

void TriangleMesh::set(Attribute attribute) {
  if (Attribute* old = find(attribute.name))
    *old = std::move(attribute);
  else
    attributes.push_back(std::move(attribute));
}

}  // namespace pelage
