#include "io/tet_file.h"

#include <algorithm>
#include <iterator>

#include "base/suggest.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/msh_reader.h"
#include "io/vtu_reader.h"
#include "io/vtu_writer.h"
#include "pelage/error.h"
#include "shape/solid_cells.h"

namespace pelage {

namespace {

struct TetFormat {
  const char* extension;
  SolidCells (*read)(std::string_view bytes, const std::string& path, std::vector<Finding>& findings);
  std::string (*bytes)(const TetMesh& volume);  ///< or nullptr
};

constexpr TetFormat formats[] = {{".vtu", read_vtu, vtu_bytes}, {".msh", read_msh, nullptr}};

const TetFormat* find_format(const std::string& path) {
  const auto* found = std::ranges::find(formats, lower_extension(path), &TetFormat::extension);
  return found == std::end(formats) ? nullptr : found;
}

}  // namespace

bool is_tet_file(const std::string& path) { return find_format(path) != nullptr; }

TetFile read_tet_bytes(std::string_view bytes, const std::string& name) {
  const TetFormat* format = find_format(name);
  if (!format)
    throw Error(Fault::input,
                "is no file of a volume that can be read; known are " + join_names(readable_tet_extensions()), {name});
  TetFile file;
  SolidCells cells = format->read(bytes, name, file.findings);
  try {
    file.volume = tets_of(std::move(cells), file.findings);
  } catch (const ShapeFault& fault) {
    throw Error(fault.fault(), fault.what(), {name});
  }
  return file;
}

TetFile read_tets(const std::string& path) { return read_tet_bytes(read_file(path), path); }

void write_tets(const TetMesh& volume, const std::string& path) {
  const TetFormat* format = find_format(path);
  if (!format || !format->bytes)
    throw Error(Fault::usage, "volumes are written as " + join_names(tet_extensions()), {path});
  std::string bytes;
  try {
    bytes = format->bytes(volume);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
  write_file(path, bytes);
}

std::vector<std::string> readable_tet_extensions() {
  std::vector<std::string> extensions;
  for (const TetFormat& format : formats) extensions.emplace_back(format.extension);
  return extensions;
}

std::vector<std::string> tet_extensions() {
  std::vector<std::string> extensions;
  for (const TetFormat& format : formats)
    if (format.bytes) extensions.emplace_back(format.extension);
  return extensions;
}

}  // namespace pelage
