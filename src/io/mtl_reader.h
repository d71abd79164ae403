#pragma once
// MtlMaterial libraries of OBJ files (MTL).

#include <array>
#include <map>
#include <string>
#include <vector>

#include "shape/finding.h"

namespace pelage {

struct MtlMaterial {
  bool colored = false;
  std::array<double, 3> color = {1, 1, 1};  ///< Kd, which MTL holds as sRGB, in linear light
  std::string image;                        ///< map_Kd, as the library names it, or empty
};

/// Adds the materials of the libraries that an mtllib of the OBJ file at `shape_path` names. A library that cannot be
/// read is a finding, as are the images of materials: they are read where --texture names them.
void read_mtl(const std::string& shape_path, const std::string& names, std::map<std::string, MtlMaterial>& materials,
              std::vector<Finding>& findings);

}  // namespace pelage
