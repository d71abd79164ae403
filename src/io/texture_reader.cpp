#include "io/texture_reader.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC  // the glTF library has the same functions
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

#include <limits>
#include <string_view>

#include "io/file_bytes.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// 16384 x 16384, the largest images that painting programs make: 1.6 GB as 16-bit colours. A header that promises more
/// is a mistake, and must not reserve memory.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

struct EncodedImage {
  std::string bytes;
  const stbi_uc* data() const { return reinterpret_cast<const stbi_uc*>(bytes.data()); }
  int size() const { return static_cast<int>(bytes.size()); }
};

[[noreturn]] void fail(const std::string& path) {
  throw Error(Fault::input, std::string("is no PNG or JPEG image that can be read: ") + stbi_failure_reason(), {path});
}

/// Whether any table of Huffman codes of a JPEG image counts more than its 256 symbols: stb_image 2.27 and older
/// write beyond their own tables then. Walks on from every marker of such tables as stb_image does, wherever it is.
bool overflows_tables(std::string_view bytes) {
  if (!bytes.starts_with('\xff')) return false;
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U; };
  for (std::size_t m = bytes.find("\xff\xc4"); m != std::string_view::npos; m = bytes.find("\xff\xc4", m + 1)) {
    const std::size_t end = m + 2 + (256 * byte(m + 2) + byte(m + 3));
    for (std::size_t table = m + 4; table < end && byte(table) / 16 <= 1 && byte(table) % 16 <= 3;) {
      std::size_t symbols = 0;
      for (std::size_t length = 1; length <= 16; ++length) symbols += byte(table + length);
      if (symbols > 256) return true;
      table += 17 + symbols;
    }
  }
  return false;
}

/// The bytes of an image whose header makes sense.
EncodedImage open_image(const std::string& path) {
  EncodedImage image{read_file(path)};
  if (image.bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(Fault::input, "is larger than 2 GiB; an image of that size is of no use here", {path});
  if (overflows_tables(image.bytes))
    throw Error(Fault::input, "is a damaged JPEG image; write it again, or as PNG", {path});
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(image.data(), image.size(), &width, &height, &channels)) fail(path);
  if (std::int64_t{width} * height > most_pixels)
    throw Error(Fault::input,
                "the image has " + std::to_string(width) + " x " + std::to_string(height) + " pixels; at most " +
                    std::to_string(most_pixels) + " can be read, make it smaller",
                {path});
  return image;
}

}  // namespace

Texture read_texture(const std::string& path) {
  const EncodedImage image = open_image(path);
  constexpr int channels = 3;
  Texture texture;
  int stored = 0;
  const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
      stbi_load_16_from_memory(image.data(), image.size(), &texture.width, &texture.height, &stored, channels),
      stbi_image_free);
  if (!pixels) fail(path);
  const auto count = static_cast<std::size_t>(channels) * static_cast<std::size_t>(texture.width) *
                     static_cast<std::size_t>(texture.height);
  texture.rgb = std::make_shared<const std::vector<std::uint16_t>>(pixels.get(), pixels.get() + count);
  return texture;
}

void check_texture(const std::string& path) { open_image(path); }

}  // namespace pelage
