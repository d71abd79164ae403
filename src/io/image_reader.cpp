#include "io/image_reader.h"

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
#include <memory>

#include "pelage/error.h"

namespace pelage {

namespace {

/// 16384 x 16384, the largest images that painting programs make: 1.6 GB as 16-bit colours. A header that promises more
/// is a mistake, and must not reserve memory.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

const stbi_uc* data(std::string_view bytes) { return reinterpret_cast<const stbi_uc*>(bytes.data()); }
int size(std::string_view bytes) { return static_cast<int>(bytes.size()); }

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

constexpr std::string_view png_magic = "\x89PNG";

/// Whether a part of a PNG image claims more bytes than the file has: stb_image reserves what it claims. Or the picture
/// begins with a part without bytes, for which it reserves none.
bool has_wrong_parts(std::string_view bytes) {
  constexpr std::size_t magic = 8, head = 8, check_sum = 4;  // length and name stand before a part
  if (!bytes.starts_with(png_magic)) return false;
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
  bool begun = false;
  for (std::size_t at = magic; at + head <= bytes.size();) {
    const std::size_t length = byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
    const std::string_view name = bytes.substr(at + 4, 4);
    if (length + check_sum > bytes.size() - at - head || (name == "IDAT" && length == 0 && !begun)) return true;
    if (name == "IEND") return false;
    begun = begun || name == "IDAT";
    at += head + length + check_sum;
  }
  return false;
}

/// Bits that a pixel takes before it is packed, at least: in PNG as the header says (its 25th byte is the depth, the
/// next the kind of colour), in JPEG one for the brightness of every eight by eight pixels.
double least_bits_per_pixel(std::string_view bytes) {
  constexpr std::size_t depth_at = 24;
  if (!bytes.starts_with(png_magic) || bytes.size() <= depth_at + 1) return 1.0 / 64;
  const int depth = static_cast<unsigned char>(bytes[depth_at]);
  switch (bytes[depth_at + 1]) {
    case 2:  // red, green, blue
      return 3 * depth;
    case 4:  // grey and alpha
      return 2 * depth;
    case 6:
      return 4 * depth;
    default:
      return depth;
  }
}

/// Whether the file is long enough for its pixels: PNG is packed by deflate, which makes of a byte no more than 1032.
bool can_hold(std::string_view bytes, std::int64_t pixels) {
  constexpr double most_packed = 1032;
  const double packed = bytes.starts_with(png_magic) ? most_packed : 1;
  return static_cast<double>(pixels) * least_bits_per_pixel(bytes) <= 8 * packed * static_cast<double>(bytes.size());
}

}  // namespace

void check_image(std::string_view bytes, const std::string& path) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(Fault::input, "is larger than 2 GiB; an image of that size is of no use here", {path});
  if (overflows_tables(bytes)) throw Error(Fault::input, "is a damaged JPEG image; write it again, or as PNG", {path});
  if (has_wrong_parts(bytes)) throw Error(Fault::input, "is a PNG image that is cut short or damaged", {path});
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data(bytes), size(bytes), &width, &height, &channels)) fail(path);
  if (std::int64_t{width} * height > most_pixels)
    throw Error(Fault::input,
                "the image has " + std::to_string(width) + " x " + std::to_string(height) + " pixels; at most " +
                    std::to_string(most_pixels) + " can be read, make it smaller",
                {path});
  if (!can_hold(bytes, std::int64_t{width} * height))
    throw Error(Fault::input,
                "is cut short or damaged: " + std::to_string(bytes.size()) + " bytes cannot hold its " +
                    std::to_string(width) + " x " + std::to_string(height) + " pixels",
                {path});
}

StoredImage read_image(std::string_view bytes, const std::string& path, int channels) {
  check_image(bytes, path);
  StoredImage image;
  image.deep = stbi_is_16_bit_from_memory(data(bytes), size(bytes)) != 0;
  int stored = 0;
  const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
      stbi_load_16_from_memory(data(bytes), size(bytes), &image.width, &image.height, &stored, channels),
      stbi_image_free);
  if (!pixels) fail(path);
  image.channels = channels > 0 ? channels : stored;
  image.samples.assign(pixels.get(), pixels.get() + static_cast<std::size_t>(image.channels) *
                                                        static_cast<std::size_t>(image.width) *
                                                        static_cast<std::size_t>(image.height));
  return image;
}

}  // namespace pelage
