#include "io/obj_writer.h"

#include <cmath>
#include <map>

#include "base/checked.h"
#include "base/srgb.h"
#include "io/bytes.h"
#include "io/output_set.h"

namespace pelage {

namespace {

/// Values of one attribute as an OBJ file holds them: a list, and per corner a place in it.
struct IndexedValues {
  const Attribute* attribute = nullptr;  ///< nullptr: the mesh does not have it
  std::vector<double> list;
  std::vector<std::int32_t> index;
};

/// Each value once, in the order of the corners; those of vertices in the order of these.
IndexedValues index_values(const PolygonMesh& mesh, const char* name) {
  const Attribute* a = mesh.find(name);
  if (!a || a->domain == Domain::face) return {};
  if (a->domain == Domain::vertex) return {a, a->values, mesh.corners};
  IndexedValues result{a, {}, {}};
  result.index.reserve(mesh.corners.size());
  const auto n = static_cast<std::ptrdiff_t>(a->components);
  std::map<std::vector<double>, std::int32_t> number;
  for (auto tuple = a->values.begin(); tuple != a->values.end(); tuple += n) {
    const auto next = static_cast<std::int32_t>(number.size());
    const auto [found, is_new] = number.try_emplace(std::vector<double>(tuple, tuple + n), next);
    if (is_new) result.list.insert(result.list.end(), tuple, tuple + n);
    result.index.push_back(found->second);
  }
  return result;
}

/// All digits of numbers that texts gave; those that were computed need no more than a float has.
void append_number(std::string& text, const Attribute& a, double value) {
  if (a.type == NumberType::float64)
    append_text(text, value);
  else
    append_text(text, static_cast<float>(value));
}

void append_list(std::string& text, const char* keyword, const IndexedValues& values) {
  if (!values.attribute) return;
  const std::size_t components = values.attribute->components;
  for (std::size_t i = 0; i < values.list.size(); i += components) {
    text += keyword;
    for (std::size_t k = 0; k < components; ++k) {
      text += ' ';
      append_number(text, *values.attribute, values.list[i + k]);
    }
    text += '\n';
  }
}

/// Four decimals: finer than the 8 bits that readers keep, and half the size of all digits.
double rounded_srgb(double linear) { return std::round(1e4 * srgb_from_linear(linear)) / 1e4; }

void append_vertices(std::string& text, const PolygonMesh& mesh, const Attribute* color) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    text += 'v';
    for (double x : mesh.points[v]) {
      text += ' ';
      append_text(text, x);
    }
    for (std::size_t k = 0; color && k < 3; ++k) {
      text += ' ';
      append_text(text, rounded_srgb(color->values[color->components * v + k]));
    }
    text += '\n';
  }
}

void append_face(std::string& text, const PolygonMesh& mesh, std::size_t f, const IndexedValues& uv,
                 const IndexedValues& normal) {
  text += 'f';
  for (std::size_t c = mesh.face_begin(f); c < mesh.face_ends[f]; ++c) {
    text += ' ';
    append_text(text, mesh.corners[c] + 1);
    if (uv.attribute || normal.attribute) text += '/';
    if (uv.attribute) append_text(text, uv.index[c] + 1);
    if (normal.attribute) {
      text += '/';
      append_text(text, normal.index[c] + 1);
    }
  }
  text += '\n';
}

/// Statements that hold for all faces behind them.
class Statements {
 public:
  explicit Statements(const PolygonMesh& mesh) {
    for (const auto& [name, keyword] :
         {std::pair{"object", "o"}, {"group", "g"}, {"material", "usemtl"}, {"smoothing", "s"}})
      if (const Attribute* a = mesh.find(name); a && a->domain == Domain::face && a->components == 1)
        list_.push_back({keyword, a, 0});
  }

  /// What has changed since the face before.
  void append(std::string& text, std::size_t f) {
    for (Statement& s : list_) {
      const double value = s.attribute->values[f];
      if (value == s.current && (f > 0 || label(*s.attribute, value).empty())) continue;
      s.current = value;
      text += std::string(s.keyword) + " " + label(*s.attribute, value) + "\n";
    }
  }

 private:
  struct Statement {
    const char* keyword;
    const Attribute* attribute;
    double current;
  };

  static std::string label(const Attribute& a, double value) {
    const auto i = saturated<std::size_t>(value);
    if (i < a.labels.size()) return a.labels[i];
    return a.name == "smoothing" && value == 0 ? "off" : std::to_string(saturated<long>(value));
  }

  std::vector<Statement> list_;
};

}  // namespace

std::string encode_obj(const PolygonMesh& mesh) {
  // A colour belongs to v, so that one per corner or face has no place in this format.
  const Attribute* color = mesh.find("color");
  if (color && !(color->domain == Domain::vertex && is_color(*color))) color = nullptr;
  const IndexedValues uv = index_values(mesh, "uv"), normal = index_values(mesh, "normal");
  std::string text = "# written by pelage\n" + comment_lines("# pelage ", record_for_files());
  for (const FileLink& link : mesh.links)
    if (link.kind == "mtllib") text += "mtllib " + link.file + "\n";
  append_vertices(text, mesh, color);
  append_list(text, "vt", uv);
  append_list(text, "vn", normal);
  Statements statements(mesh);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    statements.append(text, f);
    append_face(text, mesh, f, uv, normal);
  }
  return text;
}

}  // namespace pelage
