#include "io/grid_file.h"

#include <algorithm>
#include <iterator>

#include "base/suggest.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/image_grid.h"
#include "io/vtk_grid.h"
#include "io/vtk_grid_reader.h"
#include "pelage/error.h"

namespace pelage {

namespace {

struct GridFormat {
  const char* extension;
  GridFile (*read)(std::string_view bytes, const std::string& path);  ///< or nullptr
  std::string (*bytes)(const Grid& grid);                             ///< or nullptr
};

constexpr GridFormat formats[] = {{".vti", read_vtk_grid, vti_bytes},   {".vts", read_vtk_grid, vts_bytes},
                                  {".png", image_grid, grid_png_bytes}, {".exr", nullptr, grid_exr_bytes},
                                  {".jpg", image_grid, nullptr},        {".jpeg", image_grid, nullptr}};

const GridFormat* find_format(const std::string& path) {
  const auto* found = std::ranges::find(formats, lower_extension(path), &GridFormat::extension);
  return found == std::end(formats) ? nullptr : found;
}

}  // namespace

bool is_grid_file(const std::string& path) {
  const GridFormat* format = find_format(path);
  return format && format->read;
}

GridFile read_grid_bytes(std::string_view bytes, const std::string& name) {
  const GridFormat* format = find_format(name);
  if (!format || !format->read)
    throw Error(Fault::input,
                "is no file of a grid that can be read; known are " + join_names(readable_grid_extensions()), {name});
  return format->read(bytes, name);
}

GridFile read_grid(const std::string& path) { return read_grid_bytes(read_file(path), path); }

void write_grid(const Grid& grid, const std::string& path) {
  const GridFormat* format = find_format(path);
  if (!format || !format->bytes)
    throw Error(Fault::usage, "grids are written as " + join_names(grid_extensions()), {path});
  std::string bytes;
  try {
    bytes = format->bytes(grid);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
  write_file(path, bytes);
}

std::vector<std::string> readable_grid_extensions() {
  std::vector<std::string> extensions;
  for (const GridFormat& format : formats)
    if (format.read) extensions.emplace_back(format.extension);
  return extensions;
}

std::vector<std::string> grid_extensions() {
  std::vector<std::string> extensions;
  for (const GridFormat& format : formats)
    if (format.bytes) extensions.emplace_back(format.extension);
  return extensions;
}

}  // namespace pelage
