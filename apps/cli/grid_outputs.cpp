#include "grid_outputs.h"

#include <algorithm>

#include "base/suggest.h"
#include "catalog/shapes.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/grid_file.h"
#include "look/grid_picture.h"
#include "pelage/error.h"
#include "shape/isosurface.h"

namespace pelage {

std::vector<std::string> grid_output_extensions() { return grid_extensions(); }

bool is_grid_output(const std::string& path) {
  return std::ranges::count(grid_output_extensions(), lower_extension(path)) > 0;
}

void check_grid_output(const std::string& path, const std::string& shape) {
  check_shape_name(shape);
  if (!names_grid(shape))
    throw Error(Fault::usage,
                path + ": " + join_names(grid_output_extensions()) +
                    " are files of grids, and the shape is none; for a picture of a surface give --picture");
  check_folder(path);
}

bool is_flat(const Grid& grid) { return grid.even() || grid.dimension() == 3; }

Image picture_of_nodes(const Grid& grid, const TriangleMesh& coat, const std::array<int, 2>& tiles, int size) {
  const std::vector<double>& colors = coat.find("color")->values;
  const bool sheet = grid.dimension() == 2;
  Image image = grid_image(grid, colors);
  if (sheet) image = replicated(image, tiles[0], tiles[1]);
  const int room = std::max(1, size / std::max(image.width, image.height));
  // A line is a row of pixels: as a strip it can be seen.
  const int down = grid.dimension() == 1 ? std::max(room, size / 16) : room;
  return zoomed(image, room, down);
}

TriangleMesh surface_of(const Grid& coat, const TriangleMesh& mesh, const Paint& paint) {
  if (coat.dimension() != 3) return mesh;
  const std::string& species = paint.species[paint.shown];
  const Attribute* field = coat.find(species);
  if (!field)
    throw Error(Fault::usage,
                "a block becomes a surface by the values of " + species + "; do not leave the fields out");
  const auto [low, high] = std::ranges::minmax(field->values);
  return isosurface(coat, field->values, (low + high) / 2);
}

void save_grid(const Grid& coat, const std::string& path) { write_grid(coat, path); }

}  // namespace pelage
