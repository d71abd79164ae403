#include "io/png_writer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/srgb.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/output_set.h"
#include "io/zlib.h"
#include "pelage/io.h"

namespace pelage {

namespace {

constexpr int channels = 3;
constexpr char difference_to_the_left = 1;  // a filter
constexpr std::size_t rows_at_a_time = 16;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// One row: which filter was used, and then each byte less the one of the pixel to the left. That compresses as well as
/// the best of all filters for each row.
void filter_row(std::span<const float> rgb, const SrgbBytes& bytes, std::uint8_t* row) {
  *row++ = static_cast<std::uint8_t>(difference_to_the_left);
  std::uint8_t left[channels] = {};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const std::uint8_t byte = bytes(rgb[i]);
    row[i] = static_cast<std::uint8_t>(byte - left[i % channels]);
    left[i % channels] = byte;
  }
}

void require_picture(const Image& image, const std::string& path) {
  assert(std::ssize(image.rgb) == std::ptrdiff_t{channels} * image.width * image.height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    if (!std::isfinite(image.rgb[i]))
      throw Error(Fault::numerics, "pixel " + std::to_string(i / 3) + " of the picture is not a finite number", {path});
}

std::string filtered(const Image& image, const std::string& path) {
  require_picture(image, path);
  const std::size_t samples = std::size_t{channels} * static_cast<std::size_t>(image.width);
  std::string rows((samples + 1) * static_cast<std::size_t>(image.height), '\0');
  const SrgbBytes bytes;
  parallel_for(
      static_cast<std::size_t>(image.height),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
          filter_row({image.rgb.data() + y * samples, samples}, bytes,
                     reinterpret_cast<std::uint8_t*>(rows.data()) + y * (samples + 1));
      },
      rows_at_a_time);
  return rows;
}

/// The bytes of a row less those of the pixel to the left.
std::string filtered(const Pixels& pixels) {
  const std::size_t row = at(pixels.channels) * at(pixels.width), n = at(pixels.channels);
  std::string rows((row + 1) * at(pixels.height), difference_to_the_left);
  parallel_for(
      at(pixels.height),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
          const std::uint8_t* from = &pixels.bytes[y * row];
          char* to = &rows[y * (row + 1) + 1];
          std::copy_n(from, n, to);
          for (std::size_t i = n; i < row; ++i) to[i] = static_cast<char>(from[i] - from[i - n]);
        }
      },
      rows_at_a_time);
  return rows;
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
  append_number(file, crc32(std::string_view(file).substr(checked)));
}

/// The length of a chunk has 31 bits. In the worst case compression adds a few bytes in ten thousand.
constexpr std::int64_t most_bytes = 1'400'000'000;

/// Refuses what is too large to be written.
void check_size(std::int64_t width, std::int64_t height, std::int64_t pixel_bytes, const std::string& path) {
  const std::int64_t row = pixel_bytes * width + 1;  // one byte says how the row is filtered
  if (height <= most_bytes / row) return;
  throw Error(Fault::usage,
              "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                  " pixels is too large; at most " + std::to_string(most_bytes / pixel_bytes / 1'000'000) +
                  " million pixels can be written",
              {path});
}

enum class ColorType : char { grey = 0, rgb = 2, rgb_and_alpha = 6 };

/// `text`: of the file itself, under the keyword "pelage"; or empty.
std::string file_of(int width, int height, char bits, ColorType type, const std::string& rows,
                    const std::string& text) {
  std::string header;
  append_number(header, static_cast<std::size_t>(width));
  append_number(header, static_cast<std::size_t>(height));
  header += {bits, static_cast<char>(type), 0, 0, 0};  // the only compression and filters; not interlaced
  std::string file = "\x89PNG\r\n\x1a\n";
  append_chunk(file, "IHDR", header);
  if (!text.empty()) append_chunk(file, "tEXt", std::string("pelage") + '\0' + text);
  append_chunk(file, "IDAT", zlib_packed(rows));
  append_chunk(file, "IEND", "");
  return file;
}

/// `path` is for messages.
std::string encode_png(const Image& image, const std::string& path, const std::string& text) {
  check_picture_size(image.width, image.height, path);
  constexpr char bits = 8;
  return file_of(image.width, image.height, bits, ColorType::rgb, filtered(image, path), text);
}

/// Rows of samples, each with its high byte first, less that of the pixel to the left.
template <class Sample>
std::string deep_rows(std::size_t row_samples, std::size_t rows, std::size_t pixel_samples, Sample&& sample) {
  std::string bytes;
  bytes.reserve((2 * row_samples + 1) * rows);
  for (std::size_t y = 0; y < rows; ++y) {
    bytes += difference_to_the_left;
    for (std::size_t x = 0; x < row_samples; ++x) {
      const std::uint16_t value = sample(y * row_samples + x);
      const std::uint16_t left = x < pixel_samples ? 0 : sample(y * row_samples + x - pixel_samples);
      bytes += static_cast<char>((value >> 8) - (left >> 8));
      bytes += static_cast<char>((value & 0xff) - (left & 0xff));
    }
  }
  return bytes;
}

constexpr char deep_bits = 16;

}  // namespace

void check_picture_size(std::int64_t width, std::int64_t height, const std::string& path) {
  check_size(width, height, channels, path);
}

std::string deep_png_bytes(const Image& image, const std::string& path) {
  check_size(image.width, image.height, 2 * channels, path);
  require_picture(image, path);
  const auto samples = static_cast<std::size_t>(channels) * static_cast<std::size_t>(image.width);
  return file_of(image.width, image.height, deep_bits, ColorType::rgb,
                 deep_rows(samples, static_cast<std::size_t>(image.height), channels,
                           [&](std::size_t i) {
                             return static_cast<std::uint16_t>(std::lround(65535 * srgb_from_linear(image.rgb[i])));
                           }),
                 record_for_files());
}

std::string grey_png_bytes(int width, int height, const std::vector<std::uint16_t>& grey, const std::string& path) {
  assert(std::ssize(grey) == std::ptrdiff_t{width} * height);
  check_size(width, height, 2, path);
  return file_of(width, height, deep_bits, ColorType::grey,
                 deep_rows(static_cast<std::size_t>(width), static_cast<std::size_t>(height), 1,
                           [&](std::size_t i) { return grey[i]; }),
                 record_for_files());
}

std::string png_bytes(const Image& image) { return encode_png(image, "", ""); }

namespace {

std::string encode_png(const Pixels& pixels, const std::string& path, const std::string& text) {
  assert(std::ssize(pixels.bytes) == std::ptrdiff_t{pixels.channels} * pixels.width * pixels.height);
  check_size(pixels.width, pixels.height, pixels.channels, path);
  const ColorType type = pixels.channels == 1   ? ColorType::grey
                         : pixels.channels == 3 ? ColorType::rgb
                                                : ColorType::rgb_and_alpha;
  return file_of(pixels.width, pixels.height, 8, type, filtered(pixels), text);
}

}  // namespace

std::string png_bytes(const Pixels& pixels) { return encode_png(pixels, "", ""); }  // it may become a part of a file

void write_png(const Pixels& pixels, const std::string& path) {
  write_file(path, encode_png(pixels, path, record_for_files()));
}

void write_png(const Image& image, const std::string& path) {
  write_file(path, encode_png(image, path, record_for_files()));
}

void check_picture_path(const std::string& path) {
  if (lower_extension(path) != ".png")
    throw Error(Fault::usage, "pictures are written as PNG; end the name in .png", {path});
  expect_output(path);
}

}  // namespace pelage
