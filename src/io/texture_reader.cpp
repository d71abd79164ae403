#include "io/texture_reader.h"

#include "io/file_bytes.h"
#include "io/gltf_image.h"
#include "io/image_reader.h"

namespace pelage {

namespace {

/// Of a glTF file its image.
std::string image_bytes(const std::string& path) {
  std::string bytes = read_file(path);
  const std::string extension = lower_extension(path);
  return extension == ".glb" || extension == ".gltf" ? gltf_base_image(bytes, path) : bytes;
}

}  // namespace

Texture read_texture(const std::string& path) {
  constexpr int channels = 3;
  StoredImage image = read_image(image_bytes(path), path, channels);
  return {"", image.width, image.height, std::make_shared<const std::vector<std::uint16_t>>(std::move(image.samples))};
}

void check_texture(const std::string& path) { check_image(image_bytes(path), path); }

}  // namespace pelage
