#include "io/png_writer.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC  // the glTF library has the same functions
#include <stb_image_write.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>

#include "base/srgb.h"
#include "io/atomic_file.h"
#include "pelage/error.h"

namespace pelage {

namespace {

std::vector<std::uint8_t> to_bytes(const Image& image, const std::string& path) {
  assert(std::ssize(image.rgb) == std::ptrdiff_t{3} * image.width * image.height);
  std::vector<std::uint8_t> bytes(image.rgb.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (!std::isfinite(image.rgb[i]))
      throw Error(Fault::numerics, "pixel " + std::to_string(i / 3) + " of the picture is not a finite number", {path});
    bytes[i] = srgb_byte(image.rgb[i]);
  }
  return bytes;
}

}  // namespace

void write_png(const Image& image, const std::string& path) {
  const std::vector<std::uint8_t> bytes = to_bytes(image, path);
  std::string file;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  constexpr int channels = 3;
  if (!stbi_write_png_to_func(append, &file, image.width, image.height, channels, bytes.data(), channels * image.width))
    throw Error(Fault::output, "the picture could not be compressed", {path});
  write_file(path, file);
}

void check_picture_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c == 'P' ? 'p' : c == 'N' ? 'n' : c == 'G' ? 'g' : c;
  });
  if (extension != ".png") throw Error(Fault::usage, "pictures are written as PNG; end the name in .png", {path});
  check_folder(path);
}

}  // namespace pelage
