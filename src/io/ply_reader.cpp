#include "io/ply_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/srgb.h"
#include "io/ply_header.h"
#include "io/text_scanner.h"

namespace pelage {

namespace {

/// Values of a text file; every element begins on a line of its own.
class AsciiSource {
 public:
  AsciiSource(std::string_view bytes, const std::string& path, const PlyHeader& header)
      : text_(bytes.substr(header.size), path, header.lines + 1) {}

  bool begin_element() { return !text_.at_end(); }
  double value(PlyType) {
    if (text_.at_line_end()) text_.at_end();  // some programs break long lists into lines
    return text_.number("a number");
  }
  std::uint64_t most_values() const { return (text_.rest().size() + 1) / 2; }
  /// True if the line holds more than the header says.
  bool end_element() {
    const bool more = !text_.at_line_end();
    text_.skip_line();
    return more;
  }
  int line() const { return text_.line(); }

 private:
  TextScanner text_;
};

/// Values of a binary file in either byte order.
class BinarySource {
 public:
  BinarySource(std::string_view bytes, const std::string& path, const PlyHeader& header)
      : bytes_(bytes.substr(header.size)),
        path_(path),
        swap_((header.format == PlyFormat::big_endian) != (std::endian::native == std::endian::big)) {}

  bool begin_element() const { return true; }
  double value(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return take<float>();
      case PlyType::float64:
        return take<double>();
    }
    return 0;
  }
  std::uint64_t most_values() const { return bytes_.size() - at_; }
  bool end_element() const { return false; }
  int line() const { return 0; }

 private:
  template <class T>
  T take() {
    if (bytes_.size() - at_ < sizeof(T))
      throw Error(Fault::input, "the file ends in the middle of the data; it is cut short", {path_});
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    if (swap_) std::reverse(raw, raw + sizeof(T));
    at_ += sizeof(T);
    T result;
    std::memcpy(&result, raw, sizeof(T));
    return result;
  }

  std::string_view bytes_;
  std::string path_;
  bool swap_;
  std::size_t at_ = 0;
};

/// Position of the list of vertex numbers among the properties, or -1.
int find_indices(const PlyElement& element) {
  for (const char* name : {"vertex_indices", "vertex_index"})
    if (const int i = element.find(name); i >= 0 && element.properties[i].list) return i;
  return -1;
}

template <class Source>
class PlyReader {
 public:
  PlyReader(Source source, const std::string& path, const PlyHeader& header)
      : source_(std::move(source)), path_(path), header_(header) {}

  RawShape read() {
    bool vertices = false;
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        if (std::exchange(vertices, true)) fail("the header has two vertex elements", element.line);
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        skip(element);
      }
    }
    if (!vertices) fail("the file has no vertices (no vertex element)", 0);
    add_corner_uv();
    if (longer_.count > 0) report_longer_lines();
    return std::move(shape_);
  }

 private:
  [[noreturn]] void fail(const std::string& message, int line) const {
    throw Error(Fault::input, message, {path_, line});
  }

  [[noreturn]] void fail_at(const PlyElement& element, std::uint64_t i, const std::string& message) const {
    fail(element.name + " " + std::to_string(i) + ": " + message, source_.line());
  }

  void begin(const PlyElement& element, std::uint64_t i) {
    if (!source_.begin_element())
      fail("the file ends after " + std::to_string(i) + " of " + std::to_string(element.count) + " elements \"" +
               element.name + "\"; it is cut short",
           source_.line());
  }

  void end() {
    const int line = source_.line();
    if (source_.end_element() && longer_.count++ == 0) longer_.element = line;
  }

  std::uint64_t length(const PlyElement& element, const PlyProperty& list, std::uint64_t i) {
    const double n = source_.value(list.count_type);
    if (!(n >= 0) || n != std::floor(n) || n > static_cast<double>(source_.most_values()))
      fail_at(element, i, "its list \"" + list.name + "\" has an impossible length; the file is damaged or cut short");
    return static_cast<std::uint64_t>(n);
  }

  void skip_property(const PlyElement& element, const PlyProperty& property, std::uint64_t i) {
    const std::uint64_t n = property.list ? length(element, property, i) : 1;
    for (std::uint64_t k = 0; k < n; ++k) source_.value(property.type);
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin(element, i);
      for (const PlyProperty& property : element.properties) skip_property(element, property, i);
      end();
    }
  }

  // --- vertices ---

  void read_vertices(const PlyElement& element) {
    const std::size_t n = element.properties.size();
    std::vector<std::vector<double>> columns(n);
    std::vector<int> axis(n, -1);
    for (const auto& [name, k] : {std::pair{"x", 0}, {"y", 1}, {"z", 2}}) {
      const int i = element.find(name);
      if (i < 0 || element.properties[i].list) fail(std::string("the vertices have no property ") + name, element.line);
      axis[i] = k;
    }
    for (std::size_t k = 0; k < n; ++k)
      if (axis[k] < 0 && !element.properties[k].list) columns[k].reserve(element.count);
    shape_.mesh.points.resize(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin(element, i);
      if (source_.line() > 0) shape_.vertex_lines.push_back(source_.line());
      for (std::size_t k = 0; k < n; ++k) {
        const PlyProperty& property = element.properties[k];
        if (axis[k] >= 0)
          shape_.mesh.points[i][axis[k]] = source_.value(property.type);
        else if (property.list)
          skip_property(element, property, i);
        else
          columns[k].push_back(source_.value(property.type));
      }
      end();
    }
    add_vertex_attributes(element, columns);
  }

  /// Joins columns to the attributes they make together; the others stay alone.
  void add_vertex_attributes(const PlyElement& element, std::vector<std::vector<double>>& columns) {
    std::vector<char> used(columns.size(), 0);
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
      if (const int i = element.find(name); i >= 0) used[i] = 1;
    auto take = [&](const char* name, const std::vector<const char*>& names) {
      Attribute a{name, static_cast<int>(names.size()), Domain::vertex, {}};
      std::vector<int> which;
      for (const char* property : names) {
        const int i = element.find(property);
        if (i < 0 || used[i] || element.properties[i].list) return;
        which.push_back(i);
      }
      a.values.resize(which.size() * element.count);
      for (std::size_t c = 0; c < which.size(); ++c) {
        const std::vector<double> column = std::move(columns[which[c]]);
        used[which[c]] = 1;
        for (std::size_t v = 0; v < column.size(); ++v)
          a.values[v * which.size() + c] = decode(a.name, c, element.properties[which[c]].type, column[v]);
      }
      shape_.mesh.attributes.push_back(std::move(a));
    };
    take("color", {"red", "green", "blue", "alpha"});
    take("color", {"red", "green", "blue"});
    for (const auto& [u, v] : {std::pair{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}})
      if (!has("uv")) take("uv", {u, v});
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (!used[k] && !element.properties[k].list && !has(element.properties[k].name))
        shape_.mesh.attributes.push_back({element.properties[k].name, 1, Domain::vertex, std::move(columns[k])});
  }

  bool has(const std::string& name) const {
    return std::any_of(shape_.mesh.attributes.begin(), shape_.mesh.attributes.end(),
                       [&](const Attribute& a) { return a.name == name; });
  }

  static double decode(const std::string& name, std::size_t component, PlyType type, double value) {
    if (name != "color" || type == PlyType::float32 || type == PlyType::float64) return value;
    const double most = size_of(type) == 1 ? 255 : 65535;
    return component == 3 ? value / most : linear_from_srgb(value / most);
  }

  // --- faces ---

  std::int32_t index(const PlyElement& element, const PlyProperty& property, std::uint64_t i) {
    const double v = source_.value(property.type);
    if (!(std::abs(v) <= std::numeric_limits<std::int32_t>::max()) || v != std::floor(v))
      fail_at(element, i, "has a vertex number that is no 32-bit integer");
    return static_cast<std::int32_t>(v);
  }

  void read_faces(const PlyElement& element) {
    const int indices = find_indices(element), texcoord = element.find("texcoord");
    if (indices < 0 && element.count > 0) fail("the faces have no list vertex_indices", element.line);
    shape_.mesh.face_ends.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin(element, i);
      if (source_.line() > 0) shape_.face_lines.push_back(source_.line());
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        const PlyProperty& property = element.properties[k];
        if (k == indices) {
          const std::uint64_t n = length(element, property, i);
          for (std::uint64_t c = 0; c < n; ++c) shape_.mesh.corners.push_back(index(element, property, i));
        } else if (k == texcoord && property.list) {
          const std::uint64_t n = length(element, property, i);
          for (std::uint64_t c = 0; c < n; ++c) corner_uv_.push_back(source_.value(property.type));
        } else {
          skip_property(element, property, i);
        }
      }
      shape_.mesh.end_face();
      end();
    }
  }

  void add_corner_uv() {
    if (corner_uv_.empty() || corner_uv_.size() != 2 * shape_.mesh.corners.size()) return;
    std::erase_if(shape_.mesh.attributes, [](const Attribute& a) { return a.name == "uv"; });
    shape_.mesh.attributes.push_back({"uv", 2, Domain::corner, std::move(corner_uv_)});
  }

  /// Every vertex of a strip but the first two makes a triangle with the two before it; every second one is
  /// wound the other way.
  void read_strips(const PlyElement& element) {
    const int indices = find_indices(element);
    if (indices < 0 && element.count > 0) fail("the tristrips have no list vertex_indices", element.line);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin(element, i);
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        if (k == indices)
          read_strip(element, element.properties[k], i);
        else
          skip_property(element, element.properties[k], i);
      }
      end();
    }
  }

  void read_strip(const PlyElement& element, const PlyProperty& property, std::uint64_t i) {
    const std::uint64_t n = length(element, property, i);
    std::array<std::int32_t, 2> last{};
    std::uint64_t in_strip = 0;
    for (std::uint64_t c = 0; c < n; ++c) {
      const std::int32_t v = index(element, property, i);
      if (v == -1) {
        in_strip = 0;
        continue;
      }
      if (in_strip >= 2) {
        const bool turned = in_strip % 2 == 1;
        shape_.mesh.corners.insert(shape_.mesh.corners.end(), {last[turned ? 1 : 0], last[turned ? 0 : 1], v});
        shape_.mesh.end_face();
        if (source_.line() > 0) shape_.face_lines.push_back(source_.line());
      }
      last = {last[1], v};
      ++in_strip;
    }
  }

  void report_longer_lines() {
    longer_.text = counted(longer_.count, "line") + " with more values than the header says (first: line " +
                   std::to_string(longer_.element) + "); the values behind are skipped";
    shape_.findings.push_back(longer_);
  }

  Source source_;
  const std::string& path_;
  const PlyHeader& header_;
  RawShape shape_;
  std::vector<double> corner_uv_;
  Finding longer_{"longer-lines", "", 0, 0, true};
};

}  // namespace

RawShape read_ply(std::string_view bytes, const std::string& path) {
  const PlyHeader header = read_ply_header(bytes, path);
  if (header.format == PlyFormat::ascii) return PlyReader(AsciiSource(bytes, path, header), path, header).read();
  return PlyReader(BinarySource(bytes, path, header), path, header).read();
}

}  // namespace pelage
