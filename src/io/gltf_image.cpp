#include "io/gltf_image.h"

#include <set>

#include "io/gltf_material.h"

namespace pelage {

std::string gltf_base_image(std::string_view bytes, const std::string& path) {
  GltfDocument document(bytes, path);
  std::set<std::size_t> images;
  for (std::size_t m = 0; m < document.count("materials"); ++m)
    if (const auto number = read_material(document, m).image_number) images.insert(*number);
  if (images.empty()) document.fail("has no image of a base colour");
  if (images.size() > 1)
    document.fail("has " + std::to_string(images.size()) +
                  " images of base colours; save the one that is meant as a file of its own");
  return document.image(*images.begin());
}

}  // namespace pelage
