#include "io/vtk_xml.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/srgb.h"
#include "io/bytes.h"
#include "io/output_set.h"
#include "io/xml_text.h"

namespace pelage {

namespace {

std::string pack_color(const Attribute& color) {
  std::string bytes;
  for (std::size_t i = 0; i < color.values.size(); ++i)
    append_bytes(bytes, i % color.components == 3
                            ? static_cast<std::uint8_t>(std::lround(255 * std::clamp(color.values[i], 0.0, 1.0)))
                            : srgb_byte(color.values[i]));
  return bytes;
}

std::string pack_deep_color(const Attribute& color) {
  std::string bytes;
  for (std::size_t i = 0; i < color.values.size(); ++i) {
    const double value =
        i % color.components == 3 ? std::clamp(color.values[i], 0.0, 1.0) : srgb_from_linear(color.values[i]);
    append_bytes(bytes, static_cast<std::uint16_t>(std::lround(65535 * value)));
  }
  return bytes;
}

std::string array_name(const Attribute& a) {
  if (a.name == "color" && is_color(a)) return a.components == 4 ? "RGBA" : "RGB";
  if (a.name == "normal" && a.components == 3) return "Normals";
  if (a.name == "uv" && a.components == 2) return "TextureCoordinates";
  return a.name;
}

}  // namespace

std::string vtk_head(const std::string& kind) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind +
         "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + kind;
}

std::string vtk_tail(const std::string& kind) { return "</" + kind + ">\n</VTKFile>\n"; }

const char* vtk_name(NumberType type) {
  static constexpr const char* names[] = {"Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32"};
  return names[static_cast<int>(type)];
}

std::string packed(const std::vector<double>& values, NumberType type) {
  std::string bytes;
  for (double value : values) append_number(bytes, type, value);
  return bytes;
}

void append_vtk_array(std::string& text, const std::string& type, const std::string& name, int components,
                      const std::string& bytes, std::size_t tuples) {
  text += "<DataArray type=\"" + type + "\" Name=\"" + escape_xml(name) + "\" NumberOfComponents=\"" +
          std::to_string(components) + (tuples > 0 ? "\" NumberOfTuples=\"" + std::to_string(tuples) : "") +
          "\" format=\"binary\">";  // no white space before the base64: three.js
  std::string block;  // without a compressor the one block is its length in bytes and the values, encoded together
  append_bytes(block, static_cast<std::uint64_t>(bytes.size()));
  append_base64(text, block + bytes);
  text += "</DataArray>\n";
}

void append_vtk_attribute(std::string& text, const Attribute& a, ColorBits bits) {
  if (!is_color(a))
    append_vtk_array(text, vtk_name(a.type), array_name(a), a.components, packed(a.values, a.type));
  else if (bits == ColorBits::as_stored && a.type == NumberType::uint16)
    append_vtk_array(text, "UInt16", array_name(a), a.components, pack_deep_color(a));
  else
    append_vtk_array(text, "UInt8", array_name(a), a.components, pack_color(a));
}

std::string vtk_point_data_tag(std::span<const Attribute> attributes) {
  std::string tag = "<PointData";
  const auto first = [&](auto&& fits) {
    const auto found =
        std::ranges::find_if(attributes, [&](const Attribute& a) { return a.domain == Domain::vertex && fits(a); });
    return found == attributes.end() ? std::string() : escape_xml(array_name(*found));
  };
  const auto named = [&](const char* name) { return first([&](const Attribute& a) { return a.name == name; }); };
  std::string scalars = named("color");
  if (scalars.empty()) scalars = first([](const Attribute& a) { return a.components == 1; });
  if (!scalars.empty()) tag += " Scalars=\"" + scalars + "\"";
  if (!named("normal").empty()) tag += " Normals=\"Normals\"";
  if (!named("uv").empty()) tag += " TCoords=\"TextureCoordinates\"";
  return tag + ">\n";
}

namespace {

std::string string_array(const std::string& name, std::span<const std::string> strings) {
  std::string text = "<Array type=\"String\" Name=\"" + escape_xml(name) + "\" NumberOfTuples=\"" +
                     std::to_string(strings.size()) + "\" format=\"ascii\">";
  for (const std::string& string : strings) {
    for (unsigned char c : string) text += std::to_string(static_cast<int>(c)) + " ";
    text += "0 ";
  }
  return text + "</Array>\n";
}

}  // namespace

std::string vtk_labels(std::span<const Attribute> attributes) {
  std::string text;
  for (const Attribute& a : attributes) {
    if (!a.labels.empty()) text += string_array(a.name + "_labels", a.labels);
  }
  return text;
}

std::string vtk_record() {
  const std::string record = record_for_files();
  return record.empty() ? "" : string_array(vtk_record_name, {&record, 1});
}

std::string vtk_unit(const std::optional<double>& metres_per_unit) {
  std::string text;
  if (metres_per_unit)
    append_vtk_array(text, "Float64", "metres_per_unit", 1, packed({*metres_per_unit}, NumberType::float64), 1);
  return text;
}

void append_vtk_points(std::string& text, const std::vector<Point>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const Point& p : points) values.insert(values.end(), p.begin(), p.end());
  const auto is_float = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
  const NumberType type = std::ranges::all_of(values, is_float) ? NumberType::float32 : NumberType::float64;
  text += "<Points>\n";
  append_vtk_array(text, vtk_name(type), "Points", 3, packed(values, type));
  text += "</Points>\n";
}

void append_base64(std::string& text, const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t start = text.size();
  text.resize(start + (bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data() + start;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < count; ++k)
      group |= std::uint32_t{static_cast<unsigned char>(bytes[i + k])} << (16 - 8 * k);
    for (std::size_t k = 0; k <= count; ++k) out[k] = digits[(group >> (18 - 6 * k)) & 63];
    out += 4;
  }
}

}  // namespace pelage
