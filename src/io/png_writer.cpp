#include "io/png_writer.h"

#include <libdeflate.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/srgb.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "pelage/io.h"

namespace pelage {

namespace {

constexpr int channels = 3;

/// One row: which filter was used, and then each byte less the one of the pixel to the left. That compresses as well as
/// the best of all filters for each row.
void filter_row(std::span<const float> rgb, const SrgbBytes& bytes, std::uint8_t* row) {
  constexpr std::uint8_t difference_to_the_left = 1;
  *row++ = difference_to_the_left;
  std::uint8_t left[channels] = {};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const std::uint8_t byte = bytes(rgb[i]);
    row[i] = static_cast<std::uint8_t>(byte - left[i % channels]);
    left[i % channels] = byte;
  }
}

std::string filtered(const Image& image, const std::string& path) {
  assert(std::ssize(image.rgb) == std::ptrdiff_t{channels} * image.width * image.height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    if (!std::isfinite(image.rgb[i]))
      throw Error(Fault::numerics, "pixel " + std::to_string(i / 3) + " of the picture is not a finite number", {path});
  const std::size_t samples = std::size_t{channels} * static_cast<std::size_t>(image.width);
  std::string rows((samples + 1) * static_cast<std::size_t>(image.height), '\0');
  const SrgbBytes bytes;
  constexpr std::size_t at_a_time = 16;
  parallel_for(
      static_cast<std::size_t>(image.height),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
          filter_row({image.rgb.data() + y * samples, samples}, bytes,
                     reinterpret_cast<std::uint8_t*>(rows.data()) + y * (samples + 1));
      },
      at_a_time);
  return rows;
}

std::string compressed(const std::string& bytes, const std::string& path) {
  constexpr int level = 3;  // of 12
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw Error(Fault::output, "the picture could not be compressed", {path});
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  return out;
}

/// PNG's numbers have their highest byte first.
void append_number(std::string& file, std::size_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) file += static_cast<char>(number >> shift & 0xff);
}

void append_chunk(std::string& file, const char* name, const std::string& data) {
  append_number(file, data.size());
  const std::size_t checked = file.size();
  file += name;
  file += data;
  append_number(file, libdeflate_crc32(0, file.data() + checked, file.size() - checked));
}

/// The length of a chunk has 31 bits. In the worst case compression adds a few bytes in ten thousand.
constexpr std::int64_t most_bytes = 1'400'000'000;

/// `path` is for messages.
std::string encode_png(const Image& image, const std::string& path) {
  check_picture_size(image.width, image.height, path);
  std::string header;
  append_number(header, static_cast<std::size_t>(image.width));
  append_number(header, static_cast<std::size_t>(image.height));
  header += {8, 2, 0, 0, 0};  // bits per sample, RGB; the only compression and filters; not interlaced
  std::string file = "\x89PNG\r\n\x1a\n";
  append_chunk(file, "IHDR", header);
  append_chunk(file, "IDAT", compressed(filtered(image, path), path));
  append_chunk(file, "IEND", "");
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
  if (lower_extension(path) != ".png")
    throw Error(Fault::usage, "pictures are written as PNG; end the name in .png", {path});
  check_folder(path);
}

}  // namespace pelage
