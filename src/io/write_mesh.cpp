#include "io/write_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include "base/ascii.h"
#include "base/number.h"
#include "base/suggest.h"
#include "io/atomic_file.h"
#include "io/glb_writer.h"
#include "io/obj_writer.h"
#include "io/off_writer.h"
#include "io/ply_writer.h"
#include "io/stl_writer.h"
#include "io/vtp_writer.h"
#include "pelage/io.h"

namespace pelage {

namespace {

struct Writer {
  const char* extension;
  std::string (*encode)(const TriangleMesh&);
};

constexpr Writer writers[] = {
    {".glb", encode_glb},  //
    {".obj", encode_obj},  //
    {".off", encode_off},  //
    {".ply", encode_ply},  //
    {".stl", encode_stl},  //
    {".vtp", encode_vtp},  //
};

std::string lower(std::string text) {
  for (char& c : text) c = to_lower(c);
  return text;
}

std::string extension_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

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

void require_finite(std::span<const double> values, int components, Domain domain, const std::string& name) {
  const auto bad = std::find_if_not(values.begin(), values.end(), fits_float);
  if (bad == values.end()) return;
  const std::ptrdiff_t tuple = (bad - values.begin()) / components;
  const std::string place = domain == Domain::vertex
                                ? "vertex " + std::to_string(tuple)
                                : "corner " + std::to_string(tuple % 3) + " of face " + std::to_string(tuple / 3);
  throw Error(Fault::numerics, name + " is " + number(*bad) + " at " + place + "; nothing was written");
}

}  // namespace

void require_finite(const TriangleMesh& mesh) {
  static_assert(sizeof(Point) == 3 * sizeof(double));
  const double* coordinates = mesh.points.empty() ? nullptr : mesh.points.front().data();
  require_finite({coordinates, 3 * mesh.points.size()}, 3, Domain::vertex, "the position");
  for (const Attribute& attribute : mesh.attributes) {
    [[maybe_unused]] const std::size_t tuples =
        attribute.domain == Domain::vertex ? mesh.points.size() : 3 * mesh.triangles.size();
    assert(attribute.values.size() == tuples * attribute.components);
    require_finite(attribute.values, attribute.components, attribute.domain, "\"" + attribute.name + "\"");
  }
}

std::vector<std::string> mesh_extensions() {
  std::vector<std::string> names;
  for (const Writer& writer : writers) names.push_back(writer.extension);
  return names;
}

void check_mesh_path(const std::string& path) {
  about(path, [&] { find_writer(lower(extension_of(path))); });
  check_folder(path);
}

std::string mesh_bytes(const TriangleMesh& mesh, const std::string& extension) {
  const Writer& writer = find_writer(lower(extension));
  require_finite(mesh);
  return writer.encode(mesh);
}

void save(const TriangleMesh& mesh, const std::string& path) {
  write_file(path, about(path, [&] { return mesh_bytes(mesh, extension_of(path)); }));
}

}  // namespace pelage
