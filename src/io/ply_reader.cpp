#include "io/ply_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "io/ply_header.h"
#include "io/text_scanner.h"
#include "io/vertex_colors.h"

namespace pelage {

namespace {

/// Values of a text file; every element begins on a line of its own.
class AsciiSource {
 public:
  AsciiSource(std::string_view bytes, const std::string& path, const PlyHeader& header)
      : text_(bytes.substr(header.size), path, header.lines + 1) {}

  bool begin_element() { return !text_.at_end(); }
  double value(NumberType) {
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
  double value(NumberType type) {
    switch (type) {
      case NumberType::int8:
        return take<std::int8_t>();
      case NumberType::uint8:
        return take<std::uint8_t>();
      case NumberType::int16:
        return take<std::int16_t>();
      case NumberType::uint16:
        return take<std::uint16_t>();
      case NumberType::int32:
        return take<std::int32_t>();
      case NumberType::uint32:
        return take<std::uint32_t>();
      case NumberType::float32:
        return take<float>();
      case NumberType::float64:
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

/// The values of an element's properties, property by property; `lists` where its lists end.
struct Columns {
  std::vector<std::vector<double>> values;
  std::vector<std::vector<std::size_t>> ends;  ///< per list: behind the last value of each element
};

/// Names that together make one attribute.
struct Joined {
  const char* name;
  std::vector<const char*> properties;
};

const std::vector<Joined>& joined_properties() {
  static const std::vector<Joined> all = {{"normal", {"nx", "ny", "nz"}},
                                          {"color", {"red", "green", "blue", "alpha"}},
                                          {"color", {"red", "green", "blue"}},
                                          {"color", {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}},
                                          {"color", {"diffuse_red", "diffuse_green", "diffuse_blue"}},
                                          {"color", {"r", "g", "b", "a"}},
                                          {"color", {"r", "g", "b"}},
                                          {"uv", {"s", "t"}},
                                          {"uv", {"u", "v"}},
                                          {"uv", {"texture_u", "texture_v"}}};
  return all;
}

double least_of(NumberType type) {
  static constexpr double least[] = {0, 0, -128, 0, -32768, 0, -2147483648.0, 0};
  return least[static_cast<int>(type)];
}
double most_of(NumberType type) {
  static constexpr double most[] = {0, 0, 127, 255, 32767, 65535, 2147483647.0, 4294967295.0};
  return most[static_cast<int>(type)];
}

/// Texts can say more than the type that their header promises.
NumberType type_that_holds(const std::vector<double>& values, NumberType promised) {
  if (!is_integer(promised)) return promised;
  const bool fits = std::ranges::all_of(
      values, [&](double x) { return x == std::floor(x) && x >= least_of(promised) && x <= most_of(promised); });
  return fits ? promised : NumberType::float64;
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
    drop_incomplete_face_attributes();
    read_comments();
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

  void note_left_out(const std::string& what, std::size_t count, const std::string& why = "") {
    shape_.findings.push_back({"left-out", what + (why.empty() ? "" : ": " + why) + "; left out", count, 0, false});
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
    if (element.count == 0) return;
    note_left_out(counted(element.count, "element") + " \"" + element.name + "\"", element.count);
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin(element, i);
      for (const PlyProperty& property : element.properties) skip_property(element, property, i);
      end();
    }
  }

  void read_property(const PlyElement& element, std::size_t k, std::uint64_t i, Columns& columns) {
    const PlyProperty& property = element.properties[k];
    const std::uint64_t n = property.list ? length(element, property, i) : 1;
    for (std::uint64_t j = 0; j < n; ++j) columns.values[k].push_back(source_.value(property.type));
    if (property.list) columns.ends[k].push_back(columns.values[k].size());
  }

  static Columns columns_of(const PlyElement& element) {
    const std::size_t n = element.properties.size();
    Columns columns{std::vector<std::vector<double>>(n), std::vector<std::vector<std::size_t>>(n)};
    for (std::size_t k = 0; k < n; ++k)
      if (!element.properties[k].list) columns.values[k].reserve(element.count);
    return columns;
  }

  // --- vertices ---

  void read_vertices(const PlyElement& element) {
    const std::size_t n = element.properties.size();
    Columns columns = columns_of(element);
    std::vector<int> axis(n, -1);
    for (const auto& [name, k] : {std::pair{"x", 0}, {"y", 1}, {"z", 2}}) {
      const int i = element.find(name);
      if (i < 0 || element.properties[i].list) fail(std::string("the vertices have no property ") + name, element.line);
      axis[i] = k;
      columns.values[i] = {};
      if (element.properties[i].type == NumberType::float64) shape_.mesh.position_type = NumberType::float64;
    }
    shape_.mesh.points.resize(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin(element, i);
      if (source_.line() > 0) shape_.vertex_lines.push_back(source_.line());
      for (std::size_t k = 0; k < n; ++k) {
        if (axis[k] >= 0)
          shape_.mesh.points[i][axis[k]] = source_.value(element.properties[k].type);
        else
          read_property(element, k, i, columns);
      }
      end();
    }
    std::vector<char> used(n, 0);
    for (std::size_t k = 0; k < n; ++k) used[k] = axis[k] >= 0;
    for (std::size_t k = 0; k < n; ++k)
      if (element.properties[k].list && element.count > 0)
        note_left_out("the list \"" + element.properties[k].name + "\" of the vertices", element.count);
    add_attributes(element, Domain::vertex, columns.values, used);
  }

  /// Joins columns to the attributes they make together; the others stay alone.
  void add_attributes(const PlyElement& element, Domain domain, std::vector<std::vector<double>>& columns,
                      std::vector<char>& used) {
    std::vector<std::string> made;
    for (const Joined& joined : joined_properties()) {
      std::vector<int> which;
      for (const char* property : joined.properties)
        if (const int i = element.find(property); i >= 0 && !used[i] && !element.properties[i].list) which.push_back(i);
      if (which.size() != joined.properties.size() || std::ranges::count(made, joined.name) > 0) continue;
      made.emplace_back(joined.name);
      add(interleaved(joined.name, domain, element, columns, which));
      for (const int i : which) used[i] = 1;
    }
    add_further_colors(element, domain, columns, used);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (used[k] || property.list) continue;
      const NumberType type = type_that_holds(columns[k], property.type);
      add({property.name, 1, domain, std::move(columns[k]), type});
    }
  }

  /// "input_color_red" and so on, as this program writes them.
  void add_further_colors(const PlyElement& element, Domain domain, std::vector<std::vector<double>>& columns,
                          std::vector<char>& used) {
    const std::string red = "_red";
    for (const PlyProperty& property : element.properties) {
      if (!property.name.ends_with(red)) continue;
      const std::string name = property.name.substr(0, property.name.size() - red.size());
      std::vector<int> which;
      for (const char* end : {"_red", "_green", "_blue", "_alpha"})
        if (const int i = element.find(name + end); i >= 0 && !used[i] && !element.properties[i].list)
          which.push_back(i);
      if (which.size() < 3 || !is_color({name, static_cast<int>(which.size()), domain, {}})) continue;
      Attribute color = interleaved("color", domain, element, columns, which);
      color.name = name;
      add(std::move(color));
      for (const int i : which) used[i] = 1;
    }
  }

  Attribute interleaved(const std::string& name, Domain domain, const PlyElement& element,
                        std::vector<std::vector<double>>& columns, const std::vector<int>& which) {
    const std::size_t n = which.size();
    Attribute a{name, static_cast<int>(n), domain, std::vector<double>(n * element.count),
                element.properties[which[0]].type};
    for (std::size_t c = 0; c < n; ++c) {
      const std::vector<double> column = std::move(columns[which[c]]);
      for (std::size_t i = 0; i < column.size(); ++i) a.values[i * n + c] = column[i];
    }
    if (name != "color") return a;
    const NumberType alpha = element.properties[which.back()].type;
    for (std::size_t i = 3; n == 4 && i < a.values.size(); i += 4)
      if (alpha != a.type) a.values[i] *= full_scale(a.type) / full_scale(alpha);
    return linear_color(std::move(a.values), a.components, shape_.findings, a.type, domain);
  }

  /// Under a name of its own: "face_id" where the vertices have "id", too.
  void add(Attribute a) {
    if (shape_.mesh.find(a.name) && a.domain != Domain::vertex)
      a.name = (a.domain == Domain::face ? "face_" : "corner_") + a.name;
    while (shape_.mesh.find(a.name)) a.name += '_';
    shape_.mesh.attributes.push_back(std::move(a));
  }

  // --- faces ---

  std::int32_t index(const PlyElement& element, const PlyProperty& property, std::uint64_t i) {
    const double v = source_.value(property.type);
    if (!(std::abs(v) <= std::numeric_limits<std::int32_t>::max()) || v != std::floor(v))
      fail_at(element, i, "has a vertex number that is no 32-bit integer");
    return static_cast<std::int32_t>(v);
  }

  void read_faces(const PlyElement& element) {
    const int indices = find_indices(element);
    if (indices < 0 && element.count > 0) fail("the faces have no list vertex_indices", element.line);
    shape_.mesh.face_ends.reserve(shape_.mesh.face_count() + element.count);
    Columns columns = columns_of(element);
    const std::size_t first = shape_.mesh.face_count();
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin(element, i);
      if (source_.line() > 0) shape_.face_lines.push_back(source_.line());
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        const PlyProperty& property = element.properties[k];
        if (k != indices) {
          read_property(element, static_cast<std::size_t>(k), i, columns);
          continue;
        }
        const std::uint64_t n = length(element, property, i);
        for (std::uint64_t c = 0; c < n; ++c) shape_.mesh.corners.push_back(index(element, property, i));
      }
      shape_.mesh.end_face();
      end();
    }
    std::vector<char> used(element.properties.size(), 0);
    for (std::size_t k = 0; k < used.size(); ++k)
      if (element.properties[k].list && static_cast<int>(k) != indices && element.count > 0)
        add_list(element, element.properties[k], columns.values[k], columns.ends[k], first);
    add_attributes(element, Domain::face, columns.values, used);
  }

  /// Lists with as many values as their faces have corners, or a multiple of that, belong to the corners.
  void add_list(const PlyElement& element, const PlyProperty& property, std::vector<double>& values,
                const std::vector<std::size_t>& ends, std::size_t first) {
    const std::size_t corners = shape_.mesh.corners.size() - (first ? shape_.mesh.face_ends[first - 1] : 0);
    const std::size_t components = corners ? values.size() / corners : 0;
    bool fits = components > 0 && components <= 16;
    for (std::size_t f = 0; f < ends.size(); ++f)
      fits = fits && ends[f] - (f ? ends[f - 1] : 0) == components * shape_.mesh.face_size(first + f);
    const bool uv = property.name == "texcoord" && components == 2;
    if (!fits || (property.name == "texcoord" && !uv))
      return note_left_out("the list \"" + property.name + "\" of the faces", element.count,
                           "its lengths are not those of the corners");
    Attribute a{property.name, static_cast<int>(components), Domain::corner, std::move(values),
                type_that_holds(values, property.type)};
    if (is_color(a))
      a = linear_color(std::move(a.values), a.components, shape_.findings, property.type, Domain::corner);
    if (!uv) return add(std::move(a));
    if (std::erase_if(shape_.mesh.attributes, [](const Attribute& old) { return old.name == "uv"; }))
      note_left_out("the uv of the vertices", shape_.mesh.points.size(), "the corners have their own");
    a.name = "uv";
    shape_.mesh.attributes.push_back(std::move(a));
  }

  /// Triangles of strips bring no values.
  void drop_incomplete_face_attributes() {
    std::erase_if(shape_.mesh.attributes, [&](const Attribute& a) {
      const std::size_t tuples = a.domain == Domain::face ? shape_.mesh.face_count() : shape_.mesh.corners.size();
      const bool incomplete = a.domain != Domain::vertex && a.values.size() != tuples * a.components;
      if (incomplete) note_left_out("the property \"" + a.name + "\" of the faces", 1, "the strips have none");
      return incomplete;
    });
  }

  /// Every vertex of a strip but the first two makes a triangle with the two before it; every second one is
  /// wound the other way.
  void read_strips(const PlyElement& element) {
    const int indices = find_indices(element);
    if (indices < 0 && element.count > 0) fail("the tristrips have no list vertex_indices", element.line);
    for (int k = 0; k < static_cast<int>(element.properties.size()) && element.count > 0; ++k)
      if (k != indices)
        note_left_out("the property \"" + element.properties[k].name + "\" of the strips", element.count);
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

  // --- the rest ---

  /// "TextureFile skin.png" as MeshLab writes it, "label material 0 Fur" as this program does.
  void read_comments() {
    for (const std::string& comment : header_.comments) {
      TextScanner text(comment, path_);
      const std::string_view keyword = text.word();
      if (keyword == "TextureFile") add_image(std::string(text.rest_of_line()));
      if (keyword == "label") read_label(text);
    }
  }

  void add_image(std::string file) {
    shape_.findings.push_back({"image-not-read",
                               "the file has the image " + in_quotes(file) + "; name it with --texture to read it", 1,
                               0, false});
    shape_.mesh.links.push_back({"TextureFile", std::move(file)});
  }

  void read_label(TextScanner& text) {
    Attribute* a = shape_.mesh.find(text.word());
    if (!a || a->components != 1 || text.at_line_end()) return;
    const std::string number(text.word());
    if (number != std::to_string(a->labels.size())) return;
    a->labels.emplace_back(text.rest_of_line());
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
  Finding longer_{"longer-lines", "", 0, 0, true};
};

}  // namespace

RawShape read_ply(std::string_view bytes, const std::string& path) {
  const PlyHeader header = read_ply_header(bytes, path);
  if (header.format == PlyFormat::ascii) return PlyReader(AsciiSource(bytes, path, header), path, header).read();
  return PlyReader(BinarySource(bytes, path, header), path, header).read();
}

}  // namespace pelage
