#include "io/read_shape.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string_view>
#include <utility>

#include "io/file_bytes.h"
#include "io/gltf_reader.h"
#include "io/grid_file.h"
#include "io/obj_reader.h"
#include "io/off_reader.h"
#include "io/ply_reader.h"
#include "io/stl_reader.h"
#include "io/tet_file.h"
#include "io/text_scanner.h"
#include "io/vtp_reader.h"
#include "pelage/io.h"
#include "shape/builtin_grids.h"
#include "shape/generators.h"
#include "shape/grid.h"
#include "shape/repair.h"
#include "shape/tet_mesh.h"

namespace pelage {

namespace {

struct Format {
  const char* extension;
  const char* magic;  ///< the first bytes of every such file, or nullptr
  RawShape (*read)(std::string_view bytes, const std::string& path);
  std::optional<double>
      metres_per_unit;  ///< that the format prescribes or everybody takes, where the file says nothing
};

constexpr Format formats[] = {
    {".obj", nullptr, read_obj, {}}, {".ply", "ply", read_ply, {}},    {".stl", nullptr, read_stl, 0.001},
    {".off", nullptr, read_off, {}}, {".gltf", nullptr, read_gltf, 1}, {".glb", "glTF", read_gltf, 1},
    {".vtp", nullptr, read_vtp, {}},
};

const Format& format_of(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error(Fault::input, "is a directory, not a file", {path});
  const std::string extension = lower_extension(path);
  std::string known;
  for (const Format& format : formats) {
    if (extension == format.extension) return format;
    known += (known.empty() ? "" : " ") + std::string(format.extension);
  }
  std::vector<std::string> built_in = builtin_shape_names();
  for (const std::string& grid : builtin_grid_names()) built_in.push_back(grid);
  if (extension.empty())
    throw Error(Fault::input,
                std::ranges::count(built_in, path) > 0
                    ? "did you mean builtin:" + path + "?"
                    : "a shape needs an extension that names its format; known are " + known + ", or builtin:NAME",
                {path});
  throw Error(Fault::input,
              "cannot read files of the kind \"" + extension + "\"; known are " + known +
                  (extension == ".toml" ? "; models and recipes are given to grow by --model and --recipe" : ""),
              {path});
}

/// A file under the extension of another format would be read as nonsense.
void check_content(const Format& format, std::string_view bytes, const std::string& path) {
  for (const Format& other : formats)
    if (other.magic && other.read != format.read && bytes.starts_with(other.magic))
      throw Error(Fault::input, std::string("holds a ") + other.extension + " file; give it that extension", {path});
  refuse_wide_text(bytes, path);
}

int line_of(const std::vector<int>& lines, std::size_t index) { return index < lines.size() ? lines[index] : 0; }

/// The fault with the place in the file.
Error located(const ShapeFault& fault, const RawShape& raw, const std::string& path) {
  int line = 0;
  if (fault.element() == ShapeFault::Element::vertex) line = line_of(raw.vertex_lines, fault.index());
  if (fault.element() == ShapeFault::Element::face) line = line_of(raw.face_lines, fault.index());
  return Error(Fault::input, fault.what(), {path, line});
}

/// Blender writes its name into the head of PLY and STL, and its z axis points up there.
void guess_up(RawShape& raw, const Format& format, std::string_view bytes) {
  constexpr std::size_t head = 1000;  // bytes: comments come first
  if (format.read != read_ply && format.read != read_stl) return;
  if (bytes.substr(0, head).find("Blender") == std::string_view::npos) return;
  raw.up = UpAxis::z;
  raw.findings.push_back({"up-axis", "written by Blender: z points up, --up y if not", 0, 0, false});
}

/// STL has no unit, but programs for printing take millimetres.
void take_unit(RawShape& raw, const Format& format) {
  if (!raw.metres_per_unit) raw.metres_per_unit = format.metres_per_unit;
  if (format.read == read_stl)
    raw.findings.push_back({"unit", "STL says no unit: taken as millimetres, --input-unit if not", 0, 0, false});
}

RawShape read_raw(const Format& format, std::string_view bytes, const std::string& path) {
  check_content(format, bytes, path);
  RawShape raw = format.read(bytes, path);
  guess_up(raw, format, bytes);
  take_unit(raw, format);
  return raw;
}

/// Rides through the repair at the corners, and says afterwards which corner of the file each of them is.
constexpr const char* file_corner = "corner of the file";

Attribute corner_numbers(std::size_t corners) {
  Attribute numbers{file_corner, 1, Domain::corner, std::vector<double>(corners)};
  std::iota(numbers.values.begin(), numbers.values.end(), 0.0);
  return numbers;
}

/// For every corner of the file its vertex in the repaired mesh, -1 where its face is gone.
std::vector<std::int32_t> vertices_of_corners(const TriangleMesh& mesh, std::size_t corners) {
  std::vector<std::int32_t> vertex(corners, -1);
  const std::vector<double>& number = mesh.find(file_corner)->values;
  for (std::size_t c = 0; c < number.size(); ++c)
    vertex[static_cast<std::size_t>(number[c])] = mesh.triangles[c / 3][c % 3];
  return vertex;
}

/// Fewer points without faces say nothing of a surface.
constexpr std::size_t fewest_of_cloud = 32;

/// The name of the only object of the file, where it has one.
std::string only_name(const RawShape& raw) {
  const Attribute* object = raw.mesh.find("object");
  return object && object->labels.size() == 1 ? object->labels[0] : raw.name;
}

bool is_normal(const Attribute& a) { return a.name == "normal" && a.components == 3; }

/// Points without faces are the vertices of a mesh without triangles, in the order of the file. Scanners write them as
/// PLY, ParaView as VTP; in other formats the faces are more likely to have been lost.
bool is_cloud(const RawShape& raw, const std::string& path) {
  const bool points = raw.mesh.face_ends.empty() && raw.mesh.points.size() >= fewest_of_cloud;
  const std::string extension = lower_extension(path);
  if (points && extension != ".ply" && extension != ".vtp")
    throw Error(Fault::input, "the shape has points and no faces; clouds of points are read from PLY or VTP", {path});
  return points;
}

/// Those with coordinates to compute with; attributes follow.
void drop_lost_points(PolygonMesh& mesh, std::vector<Finding>& findings) {
  constexpr double largest = 1e75;  // as repair has it
  std::vector<std::size_t> kept;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (std::ranges::all_of(mesh.points[v], [](double x) { return std::abs(x) <= largest; })) kept.push_back(v);
  const std::size_t lost = mesh.points.size() - kept.size();
  if (lost == 0) return;
  for (std::size_t k = 0; k < kept.size(); ++k) mesh.points[k] = mesh.points[kept[k]];
  mesh.points.resize(kept.size());
  for (Attribute& a : mesh.attributes) {
    const auto n = static_cast<std::size_t>(a.components);
    for (std::size_t k = 0; k < kept.size(); ++k)
      for (std::size_t c = 0; c < n; ++c) a.values[n * k + c] = a.values[n * kept[k] + c];
    a.values.resize(n * kept.size());
  }
  findings.push_back({"lost-points", counted(lost, "point") + " without finite coordinates; left out", lost, 0, true});
}

ShapeFile cloud(RawShape raw) {
  ShapeFile file;
  file.findings = std::move(raw.findings);
  file.up = raw.up;
  file.name = only_name(raw);
  clear_non_finite_attributes(raw.mesh.attributes, file.findings);
  std::erase_if(raw.mesh.attributes, [](const Attribute& a) { return a.domain != Domain::vertex; });
  drop_lost_points(raw.mesh, file.findings);
  file.findings.push_back({"cloud", "no faces: a cloud of points", raw.mesh.points.size(), 0, false});
  file.mesh.metres_per_unit = raw.metres_per_unit;
  file.mesh.points = std::move(raw.mesh.points);
  file.mesh.attributes = std::move(raw.mesh.attributes);
  return file;
}

ShapeFile mended(RawShape raw, const std::string& path) {
  if (is_cloud(raw, path)) return cloud(std::move(raw));
  ShapeFile file;
  file.findings = std::move(raw.findings);
  file.up = raw.up;
  file.name = only_name(raw);
  raw.mesh.metres_per_unit = raw.metres_per_unit;
  clear_non_finite_attributes(raw.mesh.attributes, file.findings);
  auto source = std::make_shared<SourceShape>(SourceShape{raw.mesh, {}});
  const std::size_t corners = raw.mesh.corners.size();
  std::erase_if(raw.mesh.attributes, is_normal);  // surfaces have their own
  raw.mesh.attributes.push_back(corner_numbers(corners));
  try {
    Triangulation cut = triangulate(std::move(raw.mesh), file.findings);
    file.mesh = repair(std::move(cut.mesh), file.findings, cut.source_face);
  } catch (const ShapeFault& fault) {
    throw located(fault, raw, path);
  }
  source->vertex = vertices_of_corners(file.mesh, corners);
  std::erase_if(file.mesh.attributes, [](const Attribute& a) { return a.name == file_corner; });
  file.source = std::move(source);
  return file;
}

}  // namespace

void check_shape_path(const std::string& path) {
  if (is_builtin_grid(path)) return check_builtin_grid(path);
  if (is_builtin_shape(path)) return check_builtin_shape(path);
  if (!is_grid_file(path) && !is_tet_file(path)) format_of(path);
  require_file(path);
}

bool is_grid_shape(const std::string& path) { return is_builtin_grid(path) || is_grid_file(path); }

namespace {

ShapeFile grid_shape(GridFile grid) {
  ShapeFile file;
  file.mesh = mesh_of(grid.grid);
  file.findings = std::move(grid.findings);
  file.nodes = std::make_shared<const NodeShape>(std::move(grid.grid));
  return file;
}

ShapeFile tet_shape(TetFile tets) {
  ShapeFile file;
  file.mesh = mesh_of(tets.volume);
  file.findings = std::move(tets.findings);
  file.nodes = std::make_shared<const NodeShape>(std::move(tets.volume));
  return file;
}

}  // namespace

ShapeFile read_shape_bytes(std::string_view bytes, const std::string& name) {
  if (is_tet_file(name)) return tet_shape(read_tet_bytes(bytes, name));
  const Format& format = format_of(name);
  return mended(read_raw(format, bytes, name), name);
}

ShapeFile read_shape(const std::string& path) {
  if (is_builtin_grid(path)) return grid_shape({builtin_grid(path), {}});
  if (is_grid_file(path)) return grid_shape(read_grid(path));
  if (is_tet_file(path)) return tet_shape(read_tets(path));
  if (is_builtin_shape(path)) return {builtin_shape(path), {}, UpAxis::y, {}, nullptr};
  const Format& format = format_of(path);
  RawShape raw;
  {
    const std::string bytes = read_file(path);  // gone before the mesh is mended: the two together are large
    raw = read_raw(format, bytes, path);
  }
  return mended(std::move(raw), path);
}

namespace {

void require_numbers(const TriangleMesh& mesh, const std::string& path) {
  const auto lost = [&](std::int32_t v) {
    return v < 0 || static_cast<std::size_t>(v) >= mesh.points.size() ||
           !std::ranges::all_of(mesh.points[static_cast<std::size_t>(v)], [](double x) { return std::isfinite(x); });
  };
  if (mesh.triangles.empty()) throw Error(Fault::input, "the shape has no faces; nothing can grow on it", {path});
  for (const Triangle& t : mesh.triangles)
    if (std::ranges::any_of(t, lost)) throw Error(Fault::input, "a face has a vertex that is nowhere", {path});
}

}  // namespace

namespace {

ShapeFile unmended(RawShape raw, const std::string& path) {
  ShapeFile file;
  file.findings = std::move(raw.findings);
  file.up = raw.up;
  file.name = only_name(raw);
  clear_non_finite_attributes(raw.mesh.attributes, file.findings);
  auto source = std::make_shared<SourceShape>(SourceShape{raw.mesh, {}});
  const std::size_t corners = raw.mesh.corners.size();
  std::erase_if(raw.mesh.attributes, is_normal);
  raw.mesh.attributes.push_back(corner_numbers(corners));
  try {
    file.mesh = triangulate(std::move(raw.mesh), file.findings).mesh;
  } catch (const ShapeFault& fault) {
    throw located(fault, raw, path);
  }
  require_numbers(file.mesh, path);
  file.mesh.metres_per_unit = raw.metres_per_unit;
  source->vertex = vertices_of_corners(file.mesh, corners);
  std::erase_if(file.mesh.attributes, [](const Attribute& a) { return a.name == file_corner; });
  file.source = std::move(source);
  return file;
}

}  // namespace

ShapeFile read_polygons(const std::string& path) {
  return unmended(read_raw(format_of(path), read_file(path), path), path);
}

ShapeFile with_attribute(ShapeFile file, Attribute at_corners) {
  if (!file.source) {
    file.mesh.set(std::move(at_corners));
    return file;
  }
  RawShape raw{file.source->polygons, {}, {}, {}, file.up, file.name, file.mesh.metres_per_unit};
  raw.mesh.set(std::move(at_corners));
  const auto again = [&] {
    try {
      return mended(raw, file.name);
    } catch (const Error&) {  // as those who take polygons that do not fit together have read it
      return unmended(raw, file.name);
    }
  };
  ShapeFile result = again();
  result.findings = std::move(file.findings);
  return result;
}

ShapeFile check_shape(TriangleMesh mesh) {
  ShapeFile file;
  file.mesh = repair(std::move(mesh), file.findings);
  return file;
}

namespace {

/// What readers of files never give.
void require_sound(const PolygonMesh& mesh, const std::string& name) {
  const std::size_t corners = mesh.corners.size();
  if (!std::ranges::is_sorted(mesh.face_ends) || (mesh.face_ends.empty() ? 0 : mesh.face_ends.back()) != corners)
    throw Error(Fault::input, "its faces do not have as many corners as there are", {name});
  for (const std::int32_t v : mesh.corners)
    if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
      throw Error(Fault::input,
                  "a face has vertex " + std::to_string(v) + ", and there are " + std::to_string(mesh.points.size()),
                  {name});
  const auto count = [&](Domain domain) {
    return domain == Domain::vertex ? mesh.points.size() : domain == Domain::corner ? corners : mesh.face_count();
  };
  for (const Attribute& a : mesh.attributes)
    if (a.components < 1 || a.values.size() != count(a.domain) * static_cast<std::size_t>(a.components))
      throw Error(Fault::input,
                  a.name + " has " + std::to_string(a.values.size()) + " numbers, not " + std::to_string(a.components) +
                      " for each of " + std::to_string(count(a.domain)),
                  {name});
}

}  // namespace

ShapeFile check_shape(PolygonMesh mesh, const std::string& name) {
  require_sound(mesh, name);
  const std::optional<double> metres = mesh.metres_per_unit;
  RawShape raw{std::move(mesh), {}, {}, {}, UpAxis::y, {}, metres};
  if (raw.mesh.face_ends.empty() && raw.mesh.points.size() >= fewest_of_cloud) return cloud(std::move(raw));
  return mended(std::move(raw), name);
}

TriangleMesh load_shape(const std::string& path) { return read_shape(path).mesh; }

std::vector<std::string> readable_extensions() {
  std::vector<std::string> extensions;
  for (const Format& format : formats) extensions.push_back(format.extension);
  return extensions;
}

}  // namespace pelage
