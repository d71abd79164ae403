#pragma once
// The attributes of all parts of a glTF file, joined part after part.

#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

class JoinedAttributes {
 public:
  /// Appends the values of a part whose first vertex is `first`, tuple after tuple.
  void append(const std::string& name, int components, NumberType type, std::size_t first,
              const std::vector<double>& values);
  /// Fills what parts lack, up to a number of vertices: 0, and 1 for colours.
  void complete(std::size_t vertices);
  std::vector<Attribute> take() { return std::move(attributes_); }

 private:
  std::vector<Attribute> attributes_;
};

}  // namespace pelage
