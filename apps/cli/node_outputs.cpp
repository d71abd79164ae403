#include "node_outputs.h"

#include <algorithm>

#include "base/suggest.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/grid_file.h"
#include "io/png_writer.h"
#include "io/raw_texture.h"
#include "io/tet_file.h"
#include "look/dress.h"
#include "look/grid_picture.h"
#include "pelage/error.h"
#include "shape/grid_rows.h"
#include "shape/tet_samples.h"

namespace pelage {

namespace {

constexpr const char* raw = ".raw";

/// What can be written of a kind of shapes.
std::vector<std::string> extensions_of(const NodeShape* shape) {
  if (!shape) return {};
  if (std::holds_alternative<TetMesh>(*shape)) {
    std::vector<std::string> extensions = tet_extensions();
    extensions.insert(extensions.end(), {".vti", raw});
    return extensions;
  }
  if (std::holds_alternative<Atlas>(*shape)) return {".png"};
  const auto* grid = std::get_if<Grid>(shape);
  if (!grid) return {};
  if (grid->dimension() < 3) return grid_extensions();
  return grid->even() ? std::vector<std::string>{".vti", ".vts", raw} : std::vector<std::string>{".vts", raw};
}

/// What the coat has at its vertices, as attributes of a volume.
TetMesh on_volume(TetMesh volume, const TriangleMesh& coat) {
  volume.points = coat.points;  // it may have moved
  volume.attributes = coat.attributes;
  std::erase_if(volume.attributes, [](const Attribute& a) { return a.name == "normal"; });
  volume.metres_per_unit = coat.metres_per_unit;
  return volume;
}

Grid grid_of(const NodeShape& shape, const TriangleMesh& coat) {
  const auto* grid = std::get_if<Grid>(&shape);
  return grid ? on_grid(*grid, coat) : sampled(on_volume(std::get<TetMesh>(shape), coat));
}

}  // namespace

std::vector<std::string> node_output_extensions() {
  std::vector<std::string> extensions = grid_extensions();
  for (const std::string& more : tet_extensions()) extensions.push_back(more);
  extensions.emplace_back(raw);
  return extensions;
}

bool is_node_output(const std::string& path) {
  return std::ranges::count(node_output_extensions(), lower_extension(path)) > 0;
}

void check_node_output(const std::string& path, const NodeShape* shape) {
  const std::vector<std::string> fitting = extensions_of(shape);
  if (std::ranges::count(fitting, lower_extension(path)) > 0) return;
  if (fitting.empty())
    throw Error(Fault::usage, path + ": " + join_names(node_output_extensions()) +
                                  " are files of grids and volumes, and the shape is none; for a picture of a surface "
                                  "give --picture");
  throw Error(Fault::usage, path + ": at the nodes of this shape " + join_names(fitting) + " are written");
}

bool is_flat(const Grid& grid) { return grid.even() || grid.dimension() == 3; }

bool is_volume(const NodeShape* shape) {
  if (!shape) return false;
  const auto* grid = std::get_if<Grid>(shape);
  return grid ? grid->dimension() == 3 : std::holds_alternative<TetMesh>(*shape);
}

Image picture_of_nodes(const Grid& grid, const TriangleMesh& coat, const std::array<int, 2>& tiles, int size) {
  return picture_of_nodes(grid, grid_image(grid, coat.find("color")->values), tiles, size);
}

Image picture_of_nodes(const Grid& grid, Image image, const std::array<int, 2>& tiles, int size) {
  const bool sheet = grid.dimension() == 2;
  if (sheet) image = replicated(image, tiles[0], tiles[1]);
  const int room = std::max(1, size / std::max(image.width, image.height));
  // A line is a row of pixels: as a strip it can be seen.
  const int down = grid.dimension() == 1 ? std::max(room, size / 16) : room;
  return zoomed(image, room, down);
}

void save_height_map(const Grid& sheet, const std::vector<double>& values, const std::string& path) {
  const auto [low, high] = std::ranges::minmax(values);
  const auto grey = greys(in_rows<double>(sheet, values), low, high);
  write_file(path, grey_png_bytes(sheet.count[0], sheet.count[1], grey, path));
}

std::string save_nodes(const NodeShape& shape, const TriangleMesh& coat, const std::string& path) {
  const std::string extension = lower_extension(path);
  if (std::ranges::count(tet_extensions(), extension) > 0) {
    write_tets(on_volume(std::get<TetMesh>(shape), coat), path);
    return "";
  }
  const Grid grid = grid_of(shape, coat);
  if (extension != raw) {
    write_grid(grid, path);
    return "";
  }
  write_file(path, raw_texture_bytes(grid));
  return raw_texture_form(grid);
}

}  // namespace pelage
