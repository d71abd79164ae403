#include "io/obj_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "io/text_scanner.h"
#include "io/vertex_colors.h"

namespace pelage {

namespace {

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& path) : text_(bytes, path) {}

  RawShape read() {
    while (!text_.at_end()) {
      const std::string_view keyword = text_.word();
      if (keyword == "v")
        vertex();
      else if (keyword == "vt")
        texture_vertex();
      else if (keyword == "f")
        face();
      skip_statement();
    }
    add_attributes();
    return std::move(shape_);
  }

 private:
  /// Words are stepped through, so that a continued line is skipped as a whole.
  void skip_statement() {
    while (!text_.at_line_end()) text_.word();
    text_.skip_line();
  }

  void vertex() {
    shape_.vertex_lines.push_back(text_.line());
    Point p;
    for (double& x : p) x = text_.number("a coordinate");
    shape_.mesh.points.push_back(p);
    std::array<double, 3> extra{};
    std::size_t n = 0;
    for (; n < 3 && !text_.at_line_end(); ++n) extra[n] = text_.number("a colour");
    if (n < 3) return;  // one more: the weight of a rational curve
    colors_.insert(colors_.end(), extra.begin(), extra.end());
    ++colored_;
  }

  void texture_vertex() {
    uv_.push_back(text_.number("a texture coordinate"));
    uv_.push_back(text_.at_line_end() ? 0 : text_.number("a texture coordinate"));
  }

  void face() {
    shape_.face_lines.push_back(text_.line());
    while (!text_.at_line_end()) corner(text_.word());
    shape_.mesh.end_face();
  }

  /// "7", "7/3", "7//2" or "7/3/2".
  void corner(std::string_view word) {
    const std::size_t slash = word.find('/');
    shape_.mesh.corners.push_back(index(word.substr(0, slash), shape_.mesh.points.size(), "a vertex number"));
    std::int32_t uv = -1;
    if (slash != std::string_view::npos) {
      const std::string_view second = word.substr(slash + 1, word.find('/', slash + 1) - slash - 1);
      if (!second.empty()) uv = index(second, uv_.size() / 2, "a vt number");
    }
    corner_uv_.push_back(uv);
  }

  /// From 1 in the file, or back from the last; here from 0. Numbers too large for the mesh are left to the
  /// checks at the end, as vertices may follow.
  std::int32_t index(std::string_view word, std::size_t count, const char* what) const {
    const std::int64_t i = text_.integer(word, what);
    if (i == 0) text_.fail(std::string(what) + " is 0, but OBJ counts from 1");
    const std::int64_t from_zero = i > 0 ? i - 1 : static_cast<std::int64_t>(count) + i;
    if (from_zero < 0 || from_zero > std::numeric_limits<std::int32_t>::max())
      text_.fail(std::string(what) + " " + in_quotes(word) + " refers to nothing");
    return static_cast<std::int32_t>(from_zero);
  }

  void add_attributes() {
    PolygonMesh& mesh = shape_.mesh;
    if (colored_ > 0 && colored_ == mesh.points.size()) mesh.attributes.push_back(linear_color(std::move(colors_), 3));
    if (uv_.empty()) return;
    Attribute uv{"uv", 2, Domain::corner, {}};
    uv.values.reserve(2 * mesh.corners.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_ends[f]; ++c) {
        const std::size_t i = corner_uv_[c] < 0 ? 0 : 2 * static_cast<std::size_t>(corner_uv_[c]);
        if (corner_uv_[c] >= 0 && i >= uv_.size())
          throw ShapeFault(ShapeFault::Element::face, f,
                           "refers to vt " + std::to_string(corner_uv_[c] + 1LL) + ", but there are " +
                               std::to_string(uv_.size() / 2));
        uv.values.push_back(corner_uv_[c] < 0 ? 0 : uv_[i]);
        uv.values.push_back(corner_uv_[c] < 0 ? 0 : uv_[i + 1]);
      }
    mesh.attributes.push_back(std::move(uv));
  }

  TextScanner text_;
  RawShape shape_;
  std::vector<double> colors_;  // r g b of the vertices that have them
  std::size_t colored_ = 0;
  std::vector<double> uv_;
  std::vector<std::int32_t> corner_uv_;
};

}  // namespace

RawShape read_obj(std::string_view bytes, const std::string& path) { return ObjReader(bytes, path).read(); }

}  // namespace pelage
