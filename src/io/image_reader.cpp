#include "io/image_reader.h"

#include <cassert>

#include "io/jpeg_reader.h"
#include "io/png_reader.h"
#include "pelage/error.h"

namespace pelage {

namespace {

constexpr const char* neither = "it begins like neither";

/// Red, green and blue of each pixel.
StoredImage in_colours(const StoredImage& image) {
  constexpr std::size_t colours = 3;
  const auto stored = static_cast<std::size_t>(image.channels);
  const std::size_t step = stored < colours ? 0 : 1;  // a grey is repeated
  StoredImage rgb{image.width, image.height, colours, image.deep, {}};
  rgb.samples.reserve(image.samples.size() / stored * colours);
  for (std::size_t at = 0; at < image.samples.size(); at += stored)
    for (std::size_t k = 0; k < colours; ++k) rgb.samples.push_back(image.samples[at + step * k]);
  return rgb;
}

}  // namespace

void require_possible(const ImageClaim& claim, std::size_t file_size, const std::string& path) {
  const std::string size = std::to_string(claim.width) + " x " + std::to_string(claim.height) + " pixels";
  if (static_cast<double>(claim.width) * static_cast<double>(claim.height) > static_cast<double>(most_pixels))
    throw Error(Fault::input,
                "the image has " + size + "; at most " + std::to_string(most_pixels) + " can be read, make it smaller",
                {path});
  const auto pixels = static_cast<double>(claim.width * claim.height);
  if (pixels * claim.bits_per_pixel > 8 * static_cast<double>(file_size))
    throw Error(Fault::input,
                "is cut short or damaged: " + std::to_string(file_size) + " bytes cannot hold its " + size, {path});
}

void refuse_image(const std::string& why, const std::string& path) {
  throw Error(Fault::input, "is no PNG or JPEG image that can be read: " + why, {path});
}

void check_image(std::string_view bytes, const std::string& path) {
  if (is_png(bytes)) return check_png(bytes, path);
  if (is_jpeg(bytes)) return check_jpeg(bytes, path);
  refuse_image(neither, path);
}

StoredImage read_image(std::string_view bytes, const std::string& path, int channels) {
  assert(channels == 0 || channels == 3);
  check_image(bytes, path);
  StoredImage image = is_png(bytes) ? read_png(bytes, path) : read_jpeg(bytes, path);
  return channels == 0 || channels == image.channels ? image : in_colours(image);
}

}  // namespace pelage
