#include "io/ply_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "base/srgb.h"
#include "io/bytes.h"
#include "io/output_set.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

/// One property of an element.
struct Column {
  std::string name;
  NumberType type;
  enum class Encoding { number, srgb, alpha } encoding;
  const double* values;  // value of element i: values[stride * i]
  std::int64_t stride;
};

/// One list per face: a tuple for each of its corners.
struct List {
  std::string name;
  const Attribute* attribute;
};

const char* type_name(NumberType type) {
  static constexpr const char* names[] = {"float", "double", "char", "uchar", "short", "ushort", "int", "uint"};
  return names[static_cast<int>(type)];
}

double encoded(Column::Encoding encoding, double value) {
  if (encoding == Column::Encoding::srgb) return srgb_byte(value);
  if (encoding == Column::Encoding::alpha) return std::round(255 * std::clamp(value, 0.0, 1.0));
  return value;
}

/// The names of one element's properties.
class Names {
 public:
  /// Readers take u and v for texture coordinates, whereas here they are more likely two species.
  Names(const std::vector<Attribute>& attributes, Domain domain) {
    used_ = {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "u", "v", "texture_u", "texture_v"};
    const auto has = [&](const char* name) {
      return std::ranges::any_of(attributes, [&](const Attribute& a) { return a.domain == domain && a.name == name; });
    };
    if (has("uv") || (has("s") && has("t"))) used_.insert({"s", "t"});
    if (domain == Domain::face) used_.insert({"vertex_indices", "vertex_index", "texcoord"});
  }

  std::string clean(const std::string& name) {
    std::string result = name.empty() ? "value" : name;
    for (char& c : result)
      if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f') c = '_';
    while (!used_.insert(result).second) result += '_';
    return result;
  }

  std::vector<std::string> of(const Attribute& a) {
    if (a.name == "normal" && a.components == 3) return {"nx", "ny", "nz"};
    if (is_color(a)) {
      std::vector<std::string> names = {"red", "green", "blue", "alpha"};
      names.resize(static_cast<std::size_t>(a.components));
      for (std::string& name : names)
        if (!is_painted(a)) name = clean(a.name + "_" + name);
      return names;
    }
    if (a.name == "uv" && a.components == 2 && a.domain == Domain::vertex) return {"s", "t"};
    if (a.components == 1) return {clean(a.name)};
    std::vector<std::string> names;
    for (int k = 0; k < a.components; ++k) names.push_back(clean(a.name + "_" + std::to_string(k + 1)));
    return names;
  }

  /// The colours that programs show; faces may have only one such.
  static bool is_painted(const Attribute& a) {
    return is_color(a) && (a.name == "color" || (a.name == "face_color" && a.domain == Domain::face));
  }

 private:
  std::set<std::string> used_;
};

std::vector<Column> list_columns(const PolygonMesh& mesh, Domain domain) {
  Names names(mesh.attributes, domain);
  std::vector<Column> columns;
  for (const Attribute& a : mesh.attributes) {
    if (a.domain != domain) continue;
    const std::vector<std::string> list = names.of(a);
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto encoding = !is_color(a) ? Column::Encoding::number
                            : k == 3     ? Column::Encoding::alpha
                                         : Column::Encoding::srgb;
      columns.push_back(
          {list[k], is_color(a) ? NumberType::uint8 : a.type, encoding, a.values.data() + k, a.components});
    }
  }
  return columns;
}

std::vector<List> list_lists(const PolygonMesh& mesh) {
  Names names(mesh.attributes, Domain::face);
  std::vector<List> lists;
  for (const Attribute& a : mesh.attributes) {
    if (a.domain != Domain::corner) continue;
    lists.push_back({a.name == "uv" && a.components == 2 ? "texcoord" : names.clean(a.name), &a});
  }
  return lists;
}

std::size_t largest_face(const PolygonMesh& mesh) {
  std::size_t most = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) most = std::max(most, mesh.face_size(f));
  return most;
}

bool are_floats(const std::vector<Point>& points) {
  return std::ranges::all_of(points, [](const Point& p) {
    return std::ranges::all_of(p, [](double x) { return static_cast<float>(x) == x; });
  });
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

std::string header(const PolygonMesh& mesh, const std::vector<Column>& columns, const std::vector<Column>& face_columns,
                   const std::vector<List>& lists, bool floats) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by pelage\n";
  text += comment_lines("comment pelage ", record_for_files());
  for (const FileLink& link : mesh.links)
    if (link.kind == "TextureFile") text += "comment TextureFile " + one_line(link.file) + "\n";
  for (const Attribute& a : mesh.attributes)
    for (std::size_t i = 0; i < a.labels.size(); ++i)
      text += "comment label " + a.name + " " + std::to_string(i) + " " + one_line(a.labels[i]) + "\n";
  text += "element vertex " + std::to_string(mesh.points.size()) + "\n";
  for (const char* axis : {"x", "y", "z"})
    text += std::string("property ") + (floats ? "float " : "double ") + axis + "\n";
  for (const Column& c : columns) text += std::string("property ") + type_name(c.type) + " " + c.name + "\n";
  text += "element face " + std::to_string(mesh.face_count()) + "\n";
  text += std::string("property list ") + (largest_face(mesh) < 256 ? "uchar" : "int") + " int vertex_indices\n";
  for (const List& list : lists)
    text += std::string("property list int ") +
            type_name(is_color(*list.attribute) ? NumberType::uint8 : list.attribute->type) + " " + list.name + "\n";
  for (const Column& c : face_columns) text += std::string("property ") + type_name(c.type) + " " + c.name + "\n";
  return text + "end_header\n";
}

void append_columns(std::string& bytes, const std::vector<Column>& columns, std::size_t i) {
  for (const Column& c : columns) append_number(bytes, c.type, encoded(c.encoding, c.values[c.stride * i]));
}

void append_vertices(std::string& bytes, const PolygonMesh& mesh, const std::vector<Column>& columns, bool floats) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (double x : mesh.points[v]) append_number(bytes, floats ? NumberType::float32 : NumberType::float64, x);
    append_columns(bytes, columns, v);
  }
}

void append_list(std::string& bytes, const Attribute& a, std::size_t begin, std::size_t end) {
  const auto n = static_cast<std::size_t>(a.components);
  append_bytes(bytes, static_cast<std::int32_t>(n * (end - begin)));
  for (std::size_t i = n * begin; i < n * end; ++i) {
    const auto encoding = i % n == 3 ? Column::Encoding::alpha : Column::Encoding::srgb;
    if (is_color(a))
      append_number(bytes, NumberType::uint8, encoded(encoding, a.values[i]));
    else
      append_number(bytes, a.type, a.values[i]);
  }
}

void append_faces(std::string& bytes, const PolygonMesh& mesh, const std::vector<Column>& columns,
                  const std::vector<List>& lists) {
  const bool small = largest_face(mesh) < 256;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::size_t begin = mesh.face_begin(f), end = mesh.face_ends[f];
    append_number(bytes, small ? NumberType::uint8 : NumberType::int32, static_cast<double>(end - begin));
    for (std::size_t c = begin; c < end; ++c) append_bytes(bytes, mesh.corners[c]);
    for (const List& list : lists) append_list(bytes, *list.attribute, begin, end);
    append_columns(bytes, columns, f);
  }
}

}  // namespace

bool floats_suffice(const std::vector<Point>& points) {
  constexpr double harmless_rounding = 1e-6;
  double size = 0, rounding = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point& p : points) {
      low = std::min(low, p[d]);
      high = std::max(high, p[d]);
      rounding = std::max(rounding, std::abs(static_cast<double>(static_cast<float>(p[d])) - p[d]));
    }
    size = std::max(size, high - low);
  }
  return rounding <= harmless_rounding * size;
}

std::string encode_ply(const PolygonMesh& mesh) {
  const std::vector<Column> columns = list_columns(mesh, Domain::vertex), faces = list_columns(mesh, Domain::face);
  const std::vector<List> lists = list_lists(mesh);
  const bool floats =
      are_floats(mesh.points) || (mesh.position_type != NumberType::float64 && floats_suffice(mesh.points));
  std::string bytes = header(mesh, columns, faces, lists, floats);
  bytes.reserve(bytes.size() + mesh.points.size() * (24 + 4 * columns.size()) + 4 * mesh.corners.size() +
                mesh.face_count() * (1 + 4 * faces.size()));
  append_vertices(bytes, mesh, columns, floats);
  append_faces(bytes, mesh, faces, lists);
  return bytes;
}

std::string encode_ply(const TriangleMesh& mesh) { return encode_ply(split_corners(polygons_of(mesh))); }

}  // namespace pelage
