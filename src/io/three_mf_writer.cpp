#include "io/three_mf_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/box.h"
#include "base/srgb.h"
#include "io/bytes.h"
#include "io/output_set.h"
#include "io/ply_writer.h"
#include "io/xml_text.h"
#include "io/zip.h"

namespace pelage {

namespace {

constexpr const char* xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

constexpr const char* content_types =
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>"
    "</Types>\n";

constexpr const char* relationships =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
    "</Relationships>\n";

struct Unit {
  double metres;
  const char* name;
};
constexpr Unit units[] = {{1e-6, "micron"}, {1e-3, "millimeter"}, {1e-2, "centimeter"},
                          {0.0254, "inch"}, {0.3048, "foot"},     {1, "meter"}};

/// The unit of the file, and what coordinates are multiplied by for it.
struct Scale {
  const char* unit;
  double factor;
};

Scale scale_of(const TriangleMesh& mesh) {
  const double metres = mesh.metres_per_unit.value_or(1e-3);
  for (const Unit& unit : units)
    if (metres == unit.metres) return {unit.name, 1};
  return {"millimeter", metres / 1e-3};
}

/// The colours of a mesh, each of them once, and the one at every corner.
class ColorTable {
 public:
  ColorTable(const TriangleMesh& mesh, const Attribute& color) {
    corner_.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) corner_.push_back(number_of(color, tuple_at(mesh, color, t, k)));
  }
  std::size_t at_corner(std::size_t corner) const { return corner_[corner]; }

  void append_to(std::string& text) const {
    constexpr const char* digits = "0123456789ABCDEF";
    text += "<m:colorgroup id=\"1\">\n";
    for (const std::uint32_t color : colors_) {
      text += "<m:color color=\"#";
      for (int shift = 28; shift >= 0; shift -= 4) text += digits[color >> shift & 15];
      text += "\"/>\n";
    }
    text += "</m:colorgroup>\n";
  }

 private:
  static std::size_t tuple_at(const TriangleMesh& mesh, const Attribute& color, std::size_t t, std::size_t k) {
    if (color.domain == Domain::face) return t;
    return color.domain == Domain::corner ? 3 * t + k : static_cast<std::size_t>(mesh.triangles[t][k]);
  }
  std::size_t number_of(const Attribute& color, std::size_t tuple) {
    const auto n = static_cast<std::size_t>(color.components);
    std::uint32_t packed = 0;
    for (std::size_t k = 0; k < 3; ++k) packed = packed << 8 | srgb_byte(color.values[n * tuple + k]);
    const double alpha = n == 4 ? std::clamp(color.values[n * tuple + 3], 0.0, 1.0) : 1;
    packed = packed << 8 | static_cast<std::uint32_t>(255 * alpha + 0.5);
    const auto [found, is_new] = known_.emplace(packed, colors_.size());
    if (is_new) colors_.push_back(packed);
    return found->second;
  }

  std::vector<std::uint32_t> colors_;  ///< red in the highest byte, alpha in the lowest
  std::unordered_map<std::uint32_t, std::size_t> known_;
  std::vector<std::size_t> corner_;
};

template <class Number>
void append_field(std::string& text, const char* name, Number value) {
  text += ' ';
  text += name;
  text += "=\"";
  append_text(text, value);
  text += '"';
}

/// As many digits as the mesh has, but no more than floats have where these do.
class CoordinateText {
 public:
  explicit CoordinateText(const std::vector<Point>& points) : floats_(floats_suffice(points)) {}
  void append(std::string& text, const char* name, double x) const {
    floats_ ? append_field(text, name, static_cast<float>(x)) : append_field(text, name, x);
  }

 private:
  bool floats_;
};

void append_mesh(std::string& text, const TriangleMesh& mesh, double factor, const ColorTable* colors) {
  constexpr std::array axes = {"x", "y", "z"}, corners = {"v1", "v2", "v3"}, properties = {"p1", "p2", "p3"};
  const CoordinateText coordinates(mesh.points);
  text += "<mesh>\n<vertices>\n";
  for (const Point& p : mesh.points) {
    text += "<vertex";
    for (std::size_t d = 0; d < 3; ++d) coordinates.append(text, axes[d], factor * p[d]);
    text += "/>\n";
  }
  text += "</vertices>\n<triangles>\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "<triangle";
    for (std::size_t k = 0; k < 3; ++k) append_field(text, corners[k], mesh.triangles[t][k]);
    if (colors) text += " pid=\"1\"";
    for (std::size_t k = 0; k < 3 && colors; ++k) append_field(text, properties[k], colors->at_corner(3 * t + k));
    text += "/>\n";
  }
  text += "</triangles>\n</mesh>\n";
}

/// Upright, and moved so that no coordinate is below 0: rows are what the axes become, the last one is the way.
std::string placement(const TriangleMesh& mesh, double factor, UpAxis up) {
  const Box box = box_of(mesh.points);
  const bool lying = up == UpAxis::y;
  std::string text = lying ? "1 0 0 0 0 1 0 -1 0" : "1 0 0 0 1 0 0 0 1";
  const Point way = lying ? Point{-box.low[0], box.high[2], -box.low[1]} : Point{-box.low[0], -box.low[1], -box.low[2]};
  for (const double x : way) {
    text += ' ';
    append_text(text, static_cast<float>(factor * x));
  }
  return text;
}

std::string model_of(const TriangleMesh& mesh, const std::string& name, UpAxis up) {
  const Scale scale = scale_of(mesh);
  const Attribute* color = mesh.find("color");
  const std::string record = record_for_files();
  std::string text = xml;
  text += "<model unit=\"" + std::string(scale.unit) +
          "\" xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
          "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\"" +
          (record.empty() ? "" : " xmlns:pelage=\"urn:pelage\"") +
          ">\n<metadata name=\"Application\">pelage</metadata>\n";
  if (!record.empty()) text += "<metadata name=\"pelage:record\">" + escape_xml(record) + "</metadata>\n";
  text += "<resources>\n";
  std::string attributes = " name=\"" + escape_xml(name) + "\" type=\"model\"";
  if (color && is_color(*color)) {
    const ColorTable colors(mesh, *color);
    colors.append_to(text);
    text += "<object id=\"2\"" + attributes + " pid=\"1\" pindex=\"0\">\n";
    append_mesh(text, mesh, scale.factor, &colors);
  } else {
    text += "<object id=\"2\"" + attributes + ">\n";
    append_mesh(text, mesh, scale.factor, nullptr);
  }
  return text + "</object>\n</resources>\n<build>\n<item objectid=\"2\" transform=\"" +
         placement(mesh, scale.factor, up) + "\"/>\n</build>\n</model>\n";
}

}  // namespace

std::string encode_three_mf(const TriangleMesh& mesh, const std::string& name, UpAxis up) {
  const std::string model = model_of(mesh, name, up), types = std::string(xml) + content_types,
                    relations = std::string(xml) + relationships;
  return zip_archive({{"[Content_Types].xml", types}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}});
}

}  // namespace pelage
