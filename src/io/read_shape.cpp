#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/ascii.h"
#include "io/file_bytes.h"
#include "io/gltf_reader.h"
#include "io/obj_reader.h"
#include "io/off_reader.h"
#include "io/ply_reader.h"
#include "io/stl_reader.h"
#include "pelage/io.h"
#include "shape/generators.h"
#include "shape/repair.h"

namespace pelage {

namespace {

struct Format {
  const char* extension;
  const char* magic;  ///< the first bytes of every such file, or nullptr
  RawShape (*read)(std::string_view bytes, const std::string& path);
};

constexpr Format formats[] = {
    {".obj", nullptr, read_obj}, {".ply", "ply", read_ply},     {".stl", nullptr, read_stl},
    {".off", nullptr, read_off}, {".gltf", nullptr, read_gltf}, {".glb", "glTF", read_gltf},
};

const Format& format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), to_lower);
  std::string known;
  for (const Format& format : formats) {
    if (extension == format.extension) return format;
    known += (known.empty() ? "" : " ") + std::string(format.extension);
  }
  throw Error(Fault::input, "cannot read files of the kind \"" + extension + "\"; known are " + known, {path});
}

/// A file under the extension of another format would be read as nonsense.
void check_content(const Format& format, std::string_view bytes, const std::string& path) {
  for (const Format& other : formats)
    if (other.magic && other.read != format.read && bytes.starts_with(other.magic))
      throw Error(Fault::input, std::string("holds a ") + other.extension + " file; give it that extension", {path});
}

int line_of(const std::vector<int>& lines, std::size_t index) { return index < lines.size() ? lines[index] : 0; }

/// The fault with the place in the file.
Error located(const ShapeFault& fault, const RawShape& raw, const std::string& path) {
  int line = 0;
  if (fault.element() == ShapeFault::Element::vertex) line = line_of(raw.vertex_lines, fault.index());
  if (fault.element() == ShapeFault::Element::face) line = line_of(raw.face_lines, fault.index());
  return Error(Fault::input, fault.what(), {path, line});
}

ShapeFile mended(RawShape raw, const std::string& path) {
  ShapeFile file;
  file.findings = std::move(raw.findings);
  try {
    Triangulation cut = triangulate(std::move(raw.mesh), file.findings);
    file.mesh = repair(std::move(cut.mesh), file.findings, cut.source_face);
  } catch (const ShapeFault& fault) {
    throw located(fault, raw, path);
  }
  return file;
}

}  // namespace

ShapeFile read_shape_bytes(std::string_view bytes, const std::string& name) {
  const Format& format = format_of(name);
  check_content(format, bytes, name);
  return mended(format.read(bytes, name), name);
}

ShapeFile read_shape(const std::string& path) {
  if (is_builtin_shape(path)) return {builtin_shape(path), {}};
  const Format& format = format_of(path);
  RawShape raw;
  {
    const std::string bytes = read_file(path);  // gone before the mesh is mended: the two together are large
    check_content(format, bytes, path);
    raw = format.read(bytes, path);
  }
  return mended(std::move(raw), path);
}

ShapeFile check_shape(TriangleMesh mesh) {
  ShapeFile file;
  file.mesh = repair(std::move(mesh), file.findings);
  return file;
}

TriangleMesh load_shape(const std::string& path) { return read_shape(path).mesh; }

std::vector<std::string> readable_extensions() {
  std::vector<std::string> extensions;
  for (const Format& format : formats) extensions.push_back(format.extension);
  return extensions;
}

}  // namespace pelage
