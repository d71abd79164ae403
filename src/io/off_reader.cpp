#include "io/off_reader.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/text_scanner.h"
#include "io/vertex_colors.h"

namespace pelage {

namespace {

/// What the header word promises of every vertex: [ST][C][N]OFF.
struct Layout {
  bool uv = false, color = false, normal = false;
};

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& path) : text_(bytes, path) {}

  RawShape read() {
    read_header();
    for (std::int64_t v = 0; v < vertex_count_; ++v) read_vertex(v);
    for (std::int64_t f = 0; f < face_count_; ++f) read_face(f);
    if (!text_.at_end())
      shape_.findings.push_back({"data-behind-the-end",
                                 "the header promises " + std::to_string(face_count_) + " faces, but line " +
                                     std::to_string(text_.line()) + " holds more; skipped",
                                 1, static_cast<std::size_t>(text_.line()), false});
    if (layout_.normal) shape_.mesh.attributes.push_back({"normal", 3, Domain::vertex, std::move(normals_)});
    if (layout_.color) shape_.mesh.attributes.push_back(opaque(std::move(colors_), color_components_, Domain::vertex));
    if (layout_.uv) shape_.mesh.attributes.push_back({"uv", 2, Domain::vertex, std::move(uv_)});
    add_face_colors();
    if (longer_ > 0)
      shape_.findings.push_back({"left-out",
                                 counted(longer_, "vertex") + " with more values than the word in front of the file "
                                                              "announces (COFF for colours); left out",
                                 longer_, 0, false});
    return std::move(shape_);
  }

 private:
  Attribute opaque(std::vector<double> values, int components, Domain domain) {
    Attribute color = linear_color(std::move(values), components, shape_.findings, NumberType::float32, domain);
    drop_opaque_alpha(color);
    return color;
  }

  /// White where a face has none.
  void add_face_colors() {
    if (indexed_ > 0)
      shape_.findings.push_back({"left-out",
                                 counted(indexed_, "face") + " with the number of a colour in a list that is not in "
                                                             "the file; left out",
                                 indexed_, 0, false});
    if (colored_faces_.empty()) return;
    const std::size_t faces = shape_.mesh.face_count();
    if (colored_faces_.size() < faces)
      shape_.findings.push_back({"faces-without-colour",
                                 counted(faces - colored_faces_.size(), "face") + " without a colour; white there",
                                 faces - colored_faces_.size(), 0, false});
    const Attribute some = opaque(std::move(face_colors_), 4, Domain::face);
    Attribute all = some;
    all.type = NumberType::uint8;
    if (layout_.color) all.name = "face_color";
    all.values.assign(faces * some.components, 1.0);
    for (std::size_t i = 0; i < colored_faces_.size(); ++i)
      std::copy_n(some.values.begin() + static_cast<std::ptrdiff_t>(i) * some.components, some.components,
                  all.values.begin() + static_cast<std::ptrdiff_t>(colored_faces_[i]) * some.components);
    shape_.mesh.attributes.push_back(std::move(all));
  }

  void read_header() {
    if (text_.at_end()) text_.fail("the file holds nothing");
    TextScanner ahead = text_;
    const std::string_view word = ahead.word();
    const std::size_t off = word.find("OFF");
    if (off != std::string_view::npos) {
      read_layout(word.substr(0, off));
      text_.word();
      if (!text_.at_line_end() && word.size() == off + 3) {
        TextScanner next = text_;
        if (next.word() == "BINARY") text_.fail("binary OFF is not supported; save it as text, or as PLY");
      }
    } else if (word[0] < '0' || word[0] > '9') {  // the header word may be missing
      text_.fail("an OFF file begins with \"OFF\", this one with " + in_quotes(word));
    }
    // Some programs leave no blank between the word and the counts.
    if (off != std::string_view::npos && word.size() > off + 3)
      vertex_count_ = text_.integer(word.substr(off + 3), "the number of vertices");
    else
      vertex_count_ = next_integer("the number of vertices");
    face_count_ = next_integer("the number of faces");
    if (!text_.at_line_end()) text_.integer("the number of edges");
    check_counts();
  }

  void read_layout(std::string_view prefix) {
    if (prefix.starts_with("ST")) {
      layout_.uv = true;
      prefix.remove_prefix(2);
    }
    if (prefix.starts_with("C")) {
      layout_.color = true;
      prefix.remove_prefix(1);
    }
    if (prefix.starts_with("N")) {
      layout_.normal = true;
      prefix.remove_prefix(1);
    }
    if (!prefix.empty())
      text_.fail("OFF files of the kind " + in_quotes(prefix) + " are not supported; three coordinates a vertex are");
  }

  void check_counts() {
    if (vertex_count_ < 0 || face_count_ < 0) text_.fail("the header has a negative count");
    const auto left = static_cast<std::int64_t>(text_.rest().size());
    constexpr std::int64_t vertex_bytes = 6, face_bytes = 2;  // "0 0 0\n" and "0\n"
    if (vertex_count_ > left / vertex_bytes + 1 || face_count_ > left / face_bytes + 1)
      text_.fail("the header promises " + std::to_string(vertex_count_) + " vertices and " +
                 std::to_string(face_count_) + " faces, more than the file can hold; it is cut short or damaged");
    const std::string_view rest = text_.rest();
    const auto lines = std::count(rest.begin(), rest.end(), '\n') + std::count(rest.begin(), rest.end(), '\r');
    packed_ = lines < vertex_count_ + face_count_;
    shape_.mesh.points.reserve(vertex_count_);
    shape_.mesh.face_ends.reserve(face_count_);
    shape_.mesh.corners.reserve(3 * face_count_);
  }

  double next_number(const char* what) {
    if (text_.at_line_end() && text_.at_end())
      text_.fail(std::string("the file ends where ") + what + " should be; it is cut short");
    return text_.number(what);
  }

  std::int64_t next_integer(const char* what) {
    if (text_.at_line_end() && text_.at_end())
      text_.fail(std::string("the file ends where ") + what + " should be; it is cut short");
    return text_.integer(what);
  }

  void read_vertex(std::int64_t v) {
    if (text_.at_end())
      text_.fail("the file ends after " + std::to_string(v) + " of " + std::to_string(vertex_count_) +
                 " vertices; it is cut short");
    shape_.vertex_lines.push_back(text_.line());
    Point p;
    for (double& x : p) x = next_number("a coordinate");
    shape_.mesh.points.push_back(p);
    for (int k = 0; layout_.normal && k < 3; ++k) normals_.push_back(next_number("a normal"));
    if (layout_.color) {
      if (v == 0) color_components_ = count_color_components();
      for (int k = 0; k < color_components_; ++k) colors_.push_back(next_number("a colour"));
    }
    for (int k = 0; layout_.uv && k < 2; ++k) uv_.push_back(next_number("a texture coordinate"));
    if (packed_) return;
    longer_ += !text_.at_line_end();
    text_.skip_line();
  }

  /// The format asks for four, many programs write three: the first line tells.
  int count_color_components() const {
    if (packed_) return 4;
    TextScanner ahead = text_;
    int words = 0;
    while (!ahead.word().empty()) ++words;
    return words - (layout_.uv ? 2 : 0) == 3 ? 3 : 4;
  }

  void read_face(std::int64_t f) {
    if (text_.at_end())
      text_.fail("the file ends after " + std::to_string(f) + " of " + std::to_string(face_count_) +
                 " faces; it is cut short");
    shape_.face_lines.push_back(text_.line());
    const std::int64_t n = next_integer("a number of corners");
    if (n < 0 || n > static_cast<std::int64_t>(text_.rest().size()))
      text_.fail("face " + std::to_string(f) + ": has an impossible number of corners, " + std::to_string(n));
    for (std::int64_t k = 0; k < n; ++k) {
      const std::int64_t v = next_integer("a vertex number");
      if (v < 0 || v >= vertex_count_)
        text_.fail("face " + std::to_string(f) + ": refers to vertex " + std::to_string(v) +
                   ", but the vertices are 0 to " + std::to_string(vertex_count_ - 1) + "; correct the file");
      shape_.mesh.corners.push_back(static_cast<std::int32_t>(v));
    }
    shape_.mesh.end_face();
    if (packed_) return;
    read_face_color(static_cast<std::size_t>(f));
    text_.skip_line();
  }

  /// Nothing, the number of a colour in a list, or three or four values, behind the corners of a face. Three are
  /// completed by an alpha as bright as white.
  void read_face_color(std::size_t f) {
    std::vector<double> values;
    bool whole = true;
    while (!text_.at_line_end() && values.size() < 4) {
      const std::string_view word = text_.word();
      whole = whole && word.find('.') == std::string_view::npos;
      values.push_back(text_.number(word, "a colour"));
    }
    if (values.size() == 1) ++indexed_;
    if (values.size() < 3) return;
    if (values.size() == 3) values.push_back(whole ? 255 : 1);
    for (double& x : values) face_colors_.push_back(whole ? x / 255 : x);
    colored_faces_.push_back(f);
  }

  TextScanner text_;
  RawShape shape_;
  Layout layout_;
  std::int64_t vertex_count_ = 0, face_count_ = 0;
  bool packed_ = false;  // several elements stand on a line
  int color_components_ = 4;
  std::vector<double> colors_, uv_, normals_;
  std::vector<std::size_t> colored_faces_;  // those that have a colour
  std::vector<double> face_colors_;         // r g b a of these, 0..1
  std::size_t indexed_ = 0, longer_ = 0;
};

}  // namespace

RawShape read_off(std::string_view bytes, const std::string& path) { return OffReader(bytes, path).read(); }

}  // namespace pelage
