#include "io/png_reader.h"

#include <spng.h>

#include <memory>

namespace pelage {

namespace {

using namespace std::string_view_literals;

/// Of what is no picture (profiles, texts, unpacked): more is a bomb.
constexpr std::size_t most_beside_pixels = std::size_t{1} << 26;  // bytes

/// Deflate makes of a byte no more than this many.
constexpr double most_packed = 1032;

class PngFile {
 public:
  PngFile(std::string_view bytes, const std::string& path) : path_(path), context_(spng_ctx_new(0), spng_ctx_free) {
    if (!context_) throw std::bad_alloc();
    constexpr std::uint32_t most = most_pixels;
    require(spng_set_image_limits(context_.get(), most, most));
    require(spng_set_chunk_limits(context_.get(), most_beside_pixels, most_beside_pixels));
    require(spng_set_png_buffer(context_.get(), bytes.data(), bytes.size()));
    require(spng_get_ihdr(context_.get(), &header_));
    require_possible({header_.width, header_.height, header_.bit_depth * stored_samples() / most_packed}, bytes.size(),
                     path);
  }

  int width() const { return static_cast<int>(header_.width); }
  int height() const { return static_cast<int>(header_.height); }
  bool deep() const { return header_.bit_depth == 16; }

  /// Channels once palettes are looked up and transparency is an alpha.
  int channels() const {
    spng_trns transparency = {};
    const bool transparent = spng_get_trns(context_.get(), &transparency) == 0;
    switch (header_.color_type) {
      case SPNG_COLOR_TYPE_GRAYSCALE:
        return transparent ? 2 : 1;
      case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
        return 2;
      case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
        return 4;
      default:
        return transparent ? 4 : 3;
    }
  }

  /// Red, green, blue and alpha of every pixel, as `format` says.
  template <class Sample>
  std::vector<Sample> pixels(int format) {
    std::vector<Sample> rgba(std::size_t{4} * header_.width * header_.height);
    require(spng_decode_image(context_.get(), rgba.data(), rgba.size() * sizeof(Sample), format, SPNG_DECODE_TRNS));
    // What follows the picture may be odd, but the file has to have its end.
    if (spng_decode_chunks(context_.get()) == SPNG_IO_EOF) require(SPNG_IO_EOF);
    return rgba;
  }

 private:
  int stored_samples() const {
    switch (header_.color_type) {
      case SPNG_COLOR_TYPE_TRUECOLOR:
        return 3;
      case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
        return 2;
      case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
        return 4;
      default:
        return 1;
    }
  }

  void require(int outcome) const {
    if (outcome == SPNG_EMEM) throw std::bad_alloc();
    if (outcome == SPNG_IO_EOF || outcome == SPNG_EIDAT_TOO_SHORT) refuse_image("the file is cut short", path_);
    if (outcome != 0) refuse_image(spng_strerror(outcome), path_);
  }

  const std::string& path_;
  std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context_;
  spng_ihdr header_ = {};
};

/// Of red, green, blue and alpha those channels that the file has.
template <class Sample>
std::vector<std::uint16_t> samples_of(const std::vector<Sample>& rgba, int channels) {
  constexpr int whole = sizeof(Sample) == 1 ? 257 : 1;  // 255 * 257 is 65535
  const std::size_t colours = channels < 3 ? 1 : 3;
  std::vector<std::uint16_t> samples;
  samples.reserve(rgba.size() / 4 * static_cast<std::size_t>(channels));
  for (std::size_t at = 0; at < rgba.size(); at += 4) {
    for (std::size_t k = 0; k < colours; ++k) samples.push_back(static_cast<std::uint16_t>(whole * rgba[at + k]));
    if (channels % 2 == 0) samples.push_back(static_cast<std::uint16_t>(whole * rgba[at + 3]));
  }
  return samples;
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG"sv); }

void check_png(std::string_view bytes, const std::string& path) { PngFile(bytes, path); }

StoredImage read_png(std::string_view bytes, const std::string& path) {
  PngFile file(bytes, path);
  StoredImage image{file.width(), file.height(), file.channels(), file.deep(), {}};
  image.samples = image.deep ? samples_of(file.pixels<std::uint16_t>(SPNG_FMT_RGBA16), image.channels)
                             : samples_of(file.pixels<std::uint8_t>(SPNG_FMT_RGBA8), image.channels);
  return image;
}

}  // namespace pelage
