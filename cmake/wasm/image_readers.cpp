// src/io/png_reader.h and src/io/jpeg_reader.h by stb_image, which is a header alone. It is made for files that one
// knows; here the sandbox of WebAssembly is around it.

#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#include <stb_image.h>

#include <memory>
#include <new>

#include "io/jpeg_reader.h"
#include "io/png_reader.h"

namespace pelage {

namespace {

using namespace std::string_view_literals;

const stbi_uc* data(std::string_view bytes) { return reinterpret_cast<const stbi_uc*>(bytes.data()); }

[[noreturn]] void refuse(const std::string& path) {
  const std::string why = stbi_failure_reason();
  if (why == "outofmem") throw std::bad_alloc();
  refuse_image(why, path);
}

/// Width, height and channels.
StoredImage head_of(std::string_view bytes, const std::string& path, double least_bits) {
  StoredImage image;
  const int size = static_cast<int>(bytes.size());
  if (!stbi_info_from_memory(data(bytes), size, &image.width, &image.height, &image.channels)) refuse(path);
  require_possible({image.width, image.height, least_bits}, bytes.size(), path);
  image.deep = stbi_is_16_bit_from_memory(data(bytes), size) != 0;
  return image;
}

template <class Sample>
std::vector<std::uint16_t> samples_of(Sample* read, const StoredImage& image, const std::string& path) {
  const std::unique_ptr<Sample, void (*)(void*)> samples(read, stbi_image_free);
  if (!samples) refuse(path);
  constexpr int whole = sizeof(Sample) == 1 ? 257 : 1;  // 255 * 257 is 65535
  const std::size_t count = std::size_t{1} * image.channels * image.width * image.height;
  std::vector<std::uint16_t> wide(count);
  for (std::size_t i = 0; i < count; ++i) wide[i] = static_cast<std::uint16_t>(whole * samples.get()[i]);
  return wide;
}

StoredImage read(std::string_view bytes, const std::string& path, double least_bits) {
  StoredImage image = head_of(bytes, path, least_bits);
  const int size = static_cast<int>(bytes.size());
  int x = 0, y = 0, stored = 0;
  image.samples =
      image.deep ? samples_of(stbi_load_16_from_memory(data(bytes), size, &x, &y, &stored, image.channels), image, path)
                 : samples_of(stbi_load_from_memory(data(bytes), size, &x, &y, &stored, image.channels), image, path);
  return image;
}

constexpr double png_bits = 1.0 / 1032;  // one bit a pixel, of which deflate makes one of so many
constexpr double jpeg_bits = 1.0 / 64;   // one for the brightness of every eight by eight pixels

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG"sv); }
void check_png(std::string_view bytes, const std::string& path) { head_of(bytes, path, png_bits); }
StoredImage read_png(std::string_view bytes, const std::string& path) { return read(bytes, path, png_bits); }

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"sv); }
void check_jpeg(std::string_view bytes, const std::string& path) { head_of(bytes, path, jpeg_bits); }
StoredImage read_jpeg(std::string_view bytes, const std::string& path) { return read(bytes, path, jpeg_bits); }

}  // namespace pelage
