#include "io/image_grid.h"

#include "base/srgb.h"
#include "io/exr_writer.h"
#include "io/image_reader.h"
#include "io/png_writer.h"
#include "io/vertex_colors.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "shape/grid_rows.h"

namespace pelage {

namespace {

bool has_alpha(const StoredImage& image) { return image.channels % 2 == 0; }

/// The sample of a pixel that is channel k of a colour.
double sample(const StoredImage& image, std::size_t pixel, std::size_t k) {
  const std::size_t colors = image.channels > 2 ? 3 : 1, channels = has_alpha(image) ? colors + 1 : colors;
  return image.samples[channels * pixel + (k == 3 ? colors : k % colors)] / 65535.0;
}

/// Rows of images run downwards, those of grids upwards.
Attribute color_of(const StoredImage& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  Attribute color{"color", has_alpha(image) ? 4 : 3, Domain::vertex, {}};
  color.type = image.deep ? NumberType::uint16 : NumberType::uint8;
  color.values.reserve(color.components * width * height);
  for (std::size_t j = 0; j < height; ++j)
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t k = 0; k < static_cast<std::size_t>(color.components); ++k) {
        const double value = sample(image, (height - 1 - j) * width + i, k);
        color.values.push_back(k == 3 ? value : linear_from_srgb(value));
      }
  drop_opaque_alpha(color);
  return color;
}

}  // namespace

GridFile image_grid(std::string_view bytes, const std::string& path) {
  const StoredImage image = read_image(bytes, path);
  if (image.width < 2) throw Error(Fault::input, "the image is one pixel wide; a line lies along x, turn it", {path});
  GridFile file;
  file.grid.count = {image.width, image.height, 1};
  file.grid.set(color_of(image));
  file.findings.push_back({"unit", "one unit of length is one pixel", 0, 0, false});
  return file;
}

namespace {

void require_flat(const Grid& grid) {
  if (grid.count[2] > 1) throw Error(Fault::usage, "a block is no image; write it as .vti or .vts");
}

std::size_t components(const Attribute& a) { return static_cast<std::size_t>(a.components); }

}  // namespace

std::string grid_png_bytes(const Grid& grid) {
  require_flat(grid);
  const Attribute* color = grid.find("color");
  if (!color || !is_color(*color)) throw Error(Fault::usage, "there are no colours that an image could show");
  const Image image{grid.count[0], grid.count[1], in_rows(grid, color->values, components(*color), 0, 3)};
  return color->type == NumberType::uint16 ? deep_png_bytes(image) : png_bytes(image);
}

std::string grid_exr_bytes(const Grid& grid) {
  require_flat(grid);
  std::vector<std::string> names;
  std::vector<std::vector<float>> planes;
  for (const Attribute& a : grid.attributes)
    for (std::size_t k = 0; k < components(a); ++k) {
      const bool shown = a.name == "color" && is_color(a);
      names.push_back(shown                ? std::string(1, "RGBA"[k])
                      : components(a) == 1 ? a.name
                                           : a.name + "_" + std::to_string(k + 1));
      planes.push_back(in_rows(grid, a.values, components(a), k));
    }
  if (names.empty()) throw Error(Fault::usage, "there is nothing on the grid that an image could hold");
  return exr_bytes(names, planes, grid.count[0], grid.count[1]);
}

}  // namespace pelage
