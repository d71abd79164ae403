#include "catalog/images.h"

#include "io/texture_reader.h"

namespace pelage {

std::vector<Texture> read_images(const std::vector<TextureFile>& files) {
  std::vector<Texture> textures;
  for (const TextureFile& file : files) {
    textures.push_back(read_texture(file.path));
    textures.back().name = file.name.value;
  }
  return textures;
}

}  // namespace pelage
