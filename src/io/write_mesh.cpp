#include "io/write_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <span>

#include "base/ascii.h"
#include "base/number.h"
#include "base/srgb.h"
#include "base/suggest.h"
#include "io/atomic_file.h"
#include "io/glb_writer.h"
#include "io/gltf_coat.h"
#include "io/gltf_compressor.h"
#include "io/obj_writer.h"
#include "io/off_writer.h"
#include "io/ply_writer.h"
#include "io/stl_writer.h"
#include "io/three_mf_writer.h"
#include "io/vtp_writer.h"
#include "pelage/io.h"
#include "shape/triangulate.h"

namespace pelage {

namespace {

/// What a format does with the values of an attribute.
enum class Keeping { kept, opaque, rounded, lost };

bool is_named(const Attribute& a, std::initializer_list<const char*> names) {
  return std::ranges::any_of(names, [&](const char* name) { return a.name == name; });
}

bool any_value(const Attribute& a, bool (*test)(double)) { return std::ranges::any_of(a.values, test); }

bool no_float(double x) { return static_cast<double>(static_cast<float>(x)) != x; }
bool no_byte(double linear) { return std::abs(255 * srgb_from_linear(linear) - srgb_byte(linear)) > 1e-3; }
bool no_five_bits(double linear) {
  const double x = 31 * srgb_from_linear(linear);
  return std::abs(x - std::round(x)) > 1e-3;
}

/// Colours that were finer than 8 bits in their file; those of a coat are made to be seen, for which 8 bits serve.
Keeping as_bytes(const Attribute& color) {
  return color.type == NumberType::uint16 && any_value(color, no_byte) ? Keeping::rounded : Keeping::kept;
}

Keeping ply_keeps(const Attribute& a) { return is_color(a) ? as_bytes(a) : Keeping::kept; }

Keeping obj_keeps(const Attribute& a) {
  if (a.name == "color" && a.domain == Domain::vertex && is_color(a))
    return a.components == 4 ? Keeping::opaque : Keeping::kept;
  if (is_named(a, {"uv", "normal"})) return a.domain != Domain::face ? Keeping::kept : Keeping::lost;
  const bool statement = is_named(a, {"object", "group", "material", "smoothing", "material_color"});
  return statement && a.domain == Domain::face ? Keeping::kept : Keeping::lost;
}

Keeping off_keeps(const Attribute& a) {
  const bool here =
      (a.name == "color" && a.domain != Domain::corner) || (a.name == "face_color" && a.domain == Domain::face);
  return here && is_color(a) ? as_bytes(a) : Keeping::lost;
}

Keeping stl_keeps(const Attribute& a) {
  if (a.domain != Domain::face) return Keeping::lost;
  if (is_named(a, {"color", "face_color"}) && is_color(a))
    return a.components == 4 ? Keeping::opaque : any_value(a, no_five_bits) ? Keeping::rounded : Keeping::kept;
  return a.name == "object" ? Keeping::kept : Keeping::lost;
}

Keeping glb_keeps(const Attribute& a) {
  if (a.name == "color" && is_color(a)) return Keeping::kept;
  if (a.domain == Domain::face) return is_named(a, {"object", "material"}) ? Keeping::kept : Keeping::lost;
  if (is_named(a, {"normal", "uv"})) return Keeping::kept;  // 32 bits are enough for these
  return a.type != NumberType::float32 && any_value(a, no_float) ? Keeping::rounded : Keeping::kept;
}

Keeping vtp_keeps(const Attribute& a) { return ply_keeps(a); }

Keeping three_mf_keeps(const Attribute& a) { return a.name == "color" && is_color(a) ? as_bytes(a) : Keeping::lost; }

std::string encode_named_three_mf(const TriangleMesh& mesh, const SaveOptions& options) {
  return encode_three_mf(mesh, options.name, options.up);
}

std::string encode_named_glb(const TriangleMesh& mesh, const SaveOptions& options) {
  const std::string glb = encode_glb(mesh, {options.name, options.up, options.textures, options.repeat});
  return options.compress ? compress_glb(glb) : glb;
}

TriangleMesh triangles_of(const PolygonMesh& mesh) {
  std::vector<Finding> ignored;
  return triangulate(mesh, ignored).mesh;
}

/// Formats without polygons get triangles.
template <std::string (*encode)(const TriangleMesh&, const SaveOptions&)>
std::string triangulated(const PolygonMesh& mesh, const SaveOptions& options) {
  return encode(triangles_of(mesh), options);
}

/// Formats that neither name the mesh nor prescribe an axis.
template <class Mesh, std::string (*encode)(const Mesh&)>
std::string plain(const Mesh& mesh, const SaveOptions&) {
  return encode(mesh);
}

template <std::string (*encode)(const TriangleMesh&)>
std::string of_triangles(const PolygonMesh& mesh, const SaveOptions&) {
  return encode(triangles_of(mesh));
}

template <std::string (*encode)(const PolygonMesh&)>
std::string of_polygons(const TriangleMesh& mesh, const SaveOptions&) {
  return encode(polygons_of(mesh));
}

struct Writer {
  const char* extension;
  std::string (*encode)(const TriangleMesh&, const SaveOptions&);
  std::string (*encode_polygons)(const PolygonMesh&, const SaveOptions&);
  Keeping (*keeps)(const Attribute&);
  const char* link;  ///< the kind of link that it keeps
  bool polygons;     ///< whether it keeps faces of more than three corners
  bool digits;       ///< whether points keep what 32-bit floats would lose far from the origin
};

constexpr Writer writers[] = {
    {".3mf", encode_named_three_mf, triangulated<encode_named_three_mf>, three_mf_keeps, "", false, true},
    {".glb", encode_named_glb, triangulated<encode_named_glb>, glb_keeps, "", false, true},
    {".obj", of_polygons<encode_obj>, plain<PolygonMesh, encode_obj>, obj_keeps, "mtllib", true, true},
    {".off", of_polygons<encode_off>, plain<PolygonMesh, encode_off>, off_keeps, "", true, true},
    {".ply", plain<TriangleMesh, encode_ply>, plain<PolygonMesh, encode_ply>, ply_keeps, "TextureFile", true, true},
    {".stl", plain<TriangleMesh, encode_stl>, of_triangles<encode_stl>, stl_keeps, "", false, false},
    {".vtp", of_polygons<encode_vtp>, plain<PolygonMesh, encode_vtp>, vtp_keeps, "", true, true},
};

std::string lower(std::string text) {
  for (char& c : text) c = to_lower(c);
  return text;
}

const Writer& find_writer(const std::string& extension) {
  for (const Writer& writer : writers)
    if (extension == writer.extension) return writer;
  const std::string what = extension.empty() ? "a mesh file needs an extension that names its format"
                                             : "cannot write meshes as \"" + extension + "\"";
  const std::string hint = did_you_mean(extension, mesh_extensions());
  throw Error(Fault::usage, what + "; known: " + join_names(mesh_extensions()) + (hint.empty() ? "" : "; " + hint));
}

/// work(), whose errors are about the file.
template <class Work>
auto about(const std::string& path, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
}

bool fits_float(double x) { return std::abs(x) <= std::numeric_limits<float>::max(); }  // false for NaN

void require_finite(std::span<const double> values, const Attribute& a, bool (*fits)(double)) {
  const auto bad = std::find_if_not(values.begin(), values.end(), fits);
  if (bad == values.end()) return;
  const std::ptrdiff_t tuple = (bad - values.begin()) / a.components;
  std::string place = "vertex " + std::to_string(tuple);
  if (a.domain == Domain::face) place = "face " + std::to_string(tuple);
  if (a.domain == Domain::corner)
    place = "corner " + std::to_string(tuple % 3) + " of face " + std::to_string(tuple / 3);
  const std::string name = a.name.empty() ? "the position" : "\"" + a.name + "\"";
  throw Error(Fault::numerics, name + " is " + number(*bad) + " at " + place + "; nothing was written");
}

/// "a, b and 3 more".
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i ? ", " : "") + names[i];
  return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

std::string upper_name(const Writer& writer) {
  std::string name = writer.extension + 1;
  for (char& c : name) c = to_upper(c);
  return name;
}

/// All that a format does to a mesh beside writing it down.
std::vector<std::string> losses_of(const Writer& writer, const std::vector<Point>& points,
                                   const std::vector<Attribute>& attributes, const std::vector<FileLink>& links,
                                   bool polygons) {
  std::vector<std::string> lost, rounded, hidden, result;
  for (const Attribute& a : attributes) {
    const Keeping keeping = writer.keeps(a);
    if (keeping == Keeping::lost) lost.push_back(a.name);
    if (keeping == Keeping::opaque) lost.push_back("the alpha of " + a.name);
    if (keeping == Keeping::rounded) rounded.push_back(a.name);
  }
  for (const FileLink& link : links)
    if (link.kind != writer.link) lost.push_back("the link to " + link.file);
  if (!writer.polygons && polygons) lost.emplace_back("faces of more than three corners (they are cut)");
  if (!writer.digits && !floats_suffice(points)) rounded.emplace_back("the coordinates");
  const bool bare = std::ranges::any_of(
      attributes, [&](const Attribute& a) { return a.name == "color" && writer.keeps(a) == Keeping::lost; });
  if (!lost.empty())
    result.push_back(upper_name(writer) + " cannot hold " + listed(lost) + ": left out" +
                     (bare ? "; GLB, PLY, OBJ, VTP, OFF and 3MF hold colours" : ""));
  if (std::string(writer.extension) == ".glb")
    for (const Attribute& a : attributes)
      if (const std::string unseen = unseen_in_gltf(a); !unseen.empty()) hidden.push_back(unseen);
  if (!hidden.empty()) result.push_back("viewers of GLB do not show " + listed(hidden) + "; as images they do");
  if (!rounded.empty())
    result.push_back(upper_name(writer) + " holds fewer digits of " + listed(rounded) + ": rounded");
  return result;
}

bool has_polygons(const PolygonMesh& mesh) { return mesh.corners.size() != 3 * mesh.face_count(); }

}  // namespace

std::string extension_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

void require_finite(const std::vector<Point>& points, const std::vector<Attribute>& attributes) {
  static_assert(sizeof(Point) == 3 * sizeof(double));
  const double* coordinates = points.empty() ? nullptr : points.front().data();
  require_finite({coordinates, 3 * points.size()}, {"", 3, Domain::vertex, {}}, fits_float);
  for (const Attribute& a : attributes)
    require_finite(a.values, a, a.type == NumberType::float64 ? [](double x) { return std::isfinite(x); } : fits_float);
}

std::vector<std::string> mesh_extensions() {
  std::vector<std::string> names;
  for (const Writer& writer : writers) names.push_back(writer.extension);
  return names;
}

void check_mesh_path(const std::string& path) {
  about(path, [&] { find_writer(lower(extension_of(path))); });
  expect_output(path);
}

std::string mesh_bytes(const TriangleMesh& mesh, const std::string& extension, const SaveOptions& options) {
  const Writer& writer = find_writer(lower(extension));
  require_finite(mesh.points, mesh.attributes);
  return writer.encode(mesh, options);
}

std::string mesh_bytes(const PolygonMesh& mesh, const std::string& extension, const SaveOptions& options) {
  const Writer& writer = find_writer(lower(extension));
  require_finite(mesh);
  return writer.encode_polygons(mesh, options);
}

std::vector<std::string> losses(const TriangleMesh& mesh, const std::string& extension) {
  return losses_of(find_writer(lower(extension)), mesh.points, mesh.attributes, mesh.links, false);
}

std::vector<std::string> losses(const PolygonMesh& mesh, const std::string& extension) {
  return losses_of(find_writer(lower(extension)), mesh.points, mesh.attributes, mesh.links, has_polygons(mesh));
}

void save(const TriangleMesh& mesh, const std::string& path, const SaveOptions& options) {
  write_file(path, about(path, [&] { return mesh_bytes(mesh, extension_of(path), options); }));
}

void save(const PolygonMesh& mesh, const std::string& path, const SaveOptions& options) {
  write_file(path, about(path, [&] { return mesh_bytes(mesh, extension_of(path), options); }));
}

}  // namespace pelage
