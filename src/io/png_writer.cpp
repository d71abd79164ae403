#include "io/png_writer.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC  // the glTF library has the same functions
#include <stb_image_write.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>

#include "base/ascii.h"
#include "base/srgb.h"
#include "io/atomic_file.h"
#include "pelage/io.h"

namespace pelage {

namespace {

std::vector<std::uint8_t> samples_of(const Image& image, const std::string& path) {
  assert(std::ssize(image.rgb) == std::ptrdiff_t{3} * image.width * image.height);
  std::vector<std::uint8_t> bytes(image.rgb.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (!std::isfinite(image.rgb[i]))
      throw Error(Fault::numerics, "pixel " + std::to_string(i / 3) + " of the picture is not a finite number", {path});
    bytes[i] = srgb_byte(image.rgb[i]);
  }
  return bytes;
}

/// stb numbers the bytes of the compressed file with an int and grows their array from 3 * 2^k - 1 to twice that and
/// one: the last array that it can make holds 1.6e9. In the worst case 8 bits are coded by 9.
constexpr std::int64_t most_bytes = 1'400'000'000;

/// `path` is for messages.
std::string encode_png(const Image& image, const std::string& path) {
  check_picture_size(image.width, image.height, path);
  const std::vector<std::uint8_t> samples = samples_of(image, path);
  std::string file;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  // Differences to the left compress as well as the best of all filters for each row, and a search of 5 candidates as
  // well as one of 8, in three quarters of the time.
  stbi_write_force_png_filter = 1;
  stbi_write_png_compression_level = 5;
  constexpr int channels = 3;
  if (!stbi_write_png_to_func(append, &file, image.width, image.height, channels, samples.data(),
                              channels * image.width))
    throw Error(Fault::output, "the picture could not be compressed", {path});
  return file;
}

}  // namespace

void check_picture_size(std::int64_t width, std::int64_t height, const std::string& path) {
  const std::int64_t row = 3 * width + 1;  // one byte says how the row is filtered
  if (height <= most_bytes / row) return;
  throw Error(Fault::usage,
              "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                  " pixels is too large; at most " + std::to_string(most_bytes / 3'000'000) +
                  " million pixels can be written",
              {path});
}

std::string png_bytes(const Image& image) { return encode_png(image, ""); }

void write_png(const Image& image, const std::string& path) { write_file(path, encode_png(image, path)); }

void check_picture_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), to_lower);
  if (extension != ".png") throw Error(Fault::usage, "pictures are written as PNG; end the name in .png", {path});
  check_folder(path);
}

}  // namespace pelage
