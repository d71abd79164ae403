#include "io/obj_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "io/mtl_reader.h"
#include "io/text_scanner.h"
#include "io/vertex_colors.h"

namespace pelage {

namespace {

/// What a statement like usemtl says of all faces behind it.
class FaceLabels {
 public:
  void begin(std::string label) {
    const auto [found, is_new] = number_.emplace(std::move(label), labels_.size());
    if (is_new) labels_.push_back(found->first);
    current_ = static_cast<double>(found->second);
    used_ = true;
  }
  /// Faces before the first statement have an empty label.
  void add_face() {
    if (labels_.empty()) {
      begin("");
      used_ = false;
    }
    values_.push_back(current_);
  }
  bool used() const { return used_; }
  const std::vector<std::string>& labels() const { return labels_; }
  const std::vector<double>& values() const { return values_; }
  Attribute attribute(const std::string& name) && {
    return {name, 1, Domain::face, std::move(values_), NumberType::int32, std::move(labels_)};
  }

 private:
  std::map<std::string, std::size_t> number_;
  std::vector<std::string> labels_;
  std::vector<double> values_;
  double current_ = 0;
  bool used_ = false;
};

/// A list of the file (vt, vn) and what the corners take of it, -1 for nothing.
struct CornerList {
  const char* keyword;
  std::size_t components;
  std::vector<double> values = {};
  std::vector<std::int32_t> corners = {};
  std::size_t size() const { return values.size() / components; }
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& path) : bytes_(bytes), text_(bytes, path), path_(path) {}

  RawShape read() {
    while (!text_.at_end()) {
      statement(text_.word());
      skip_statement();
    }
    add_colors();
    add_polypaint();
    add_corner_list(uv_, "uv");
    add_corner_list(normal_, "normal");
    add_labels();
    report();
    return std::move(shape_);
  }

 private:
  /// Words are stepped through, so that a continued line is skipped as a whole.
  void skip_statement() {
    while (!text_.at_line_end()) text_.word();
    text_.skip_line();
  }

  void statement(std::string_view keyword) {
    if (keyword == "v")
      vertex();
    else if (keyword == "vt")
      texture_vertex();
    else if (keyword == "vn")
      normal();
    else if (keyword == "f")
      face();
    else if (keyword == "o")
      object_.begin(std::string(text_.rest_of_line()));
    else if (keyword == "g")
      group_.begin(std::string(text_.rest_of_line()));
    else if (keyword == "usemtl")
      material_.begin(std::string(text_.rest_of_line()));
    else if (keyword == "s")
      smoothing();
    else if (keyword == "mtllib")
      shape_.mesh.links.push_back({"mtllib", std::string(text_.rest_of_line())});
    else
      left_out_.try_emplace(std::string(keyword), Count{0, text_.line()}).first->second.count++;
  }

  void vertex() {
    shape_.vertex_lines.push_back(text_.line());
    Point p;
    for (double& x : p) x = text_.number("a coordinate");
    shape_.mesh.points.push_back(p);
    std::array<double, 3> extra{};
    std::size_t n = 0;
    for (; n < 3 && !text_.at_line_end(); ++n) extra[n] = text_.number("a colour");
    weights_ += n == 1 && extra[0] != 1;  // one more: the weight of a rational curve
    extras_ += n == 2 || !text_.at_line_end();
    if (n < 3) return;
    colored_.push_back(static_cast<std::int32_t>(shape_.mesh.points.size() - 1));
    colors_.insert(colors_.end(), extra.begin(), extra.end());
  }

  void texture_vertex() {
    uv_.values.push_back(text_.number("a texture coordinate"));
    uv_.values.push_back(text_.at_line_end() ? 0 : text_.number("a texture coordinate"));
    depths_ += !text_.at_line_end() && text_.number("a texture coordinate") != 0;
  }

  void normal() {
    for (int k = 0; k < 3; ++k) normal_.values.push_back(text_.number("a normal"));
  }

  void smoothing() {
    const std::string_view word = text_.word();
    smooth_ = word == "off" || word.empty() ? 0 : static_cast<double>(text_.integer(word, "a smoothing group"));
    smoothed_ = smoothed_ || smooth_ != 0;
  }

  void face() {
    shape_.face_lines.push_back(text_.line());
    while (!text_.at_line_end()) corner(text_.word());
    shape_.mesh.end_face();
    for (FaceLabels* labels : {&object_, &group_, &material_}) labels->add_face();
    smoothing_.push_back(smooth_);
  }

  /// "7", "7/3", "7//2" or "7/3/2".
  void corner(std::string_view word) {
    shape_.mesh.corners.push_back(index(word.substr(0, word.find('/')), shape_.mesh.points.size(), "a vertex number"));
    for (CornerList* list : {&uv_, &normal_}) {
      const std::size_t slash = word.find('/');
      word = slash == std::string_view::npos ? std::string_view() : word.substr(slash + 1);
      const std::string_view number = word.substr(0, word.find('/'));
      list->corners.push_back(
          number.empty() ? -1 : index(number, list->size(), list == &uv_ ? "a vt number" : "a vn number"));
    }
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

  void note(const std::string& kind, const std::string& text, std::size_t count) {
    shape_.findings.push_back({kind, text, count, 0, false});
  }

  void add_colors() {
    if (colored_.empty()) return;
    Attribute some = linear_color(std::move(colors_), 3, shape_.findings);
    const std::size_t vertices = shape_.mesh.points.size();
    if (colored_.size() < vertices)
      note("vertices-without-colour", counted(vertices - colored_.size(), "vertex") + " without a colour; white there",
           vertices - colored_.size());
    Attribute all{"color", 3, Domain::vertex, std::vector<double>(3 * vertices, 1.0), some.type};
    for (std::size_t i = 0; i < colored_.size(); ++i)
      std::copy_n(some.values.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                  all.values.begin() + std::ptrdiff_t{3} * colored_[i]);
    shape_.mesh.attributes.push_back(std::move(all));
  }

  /// ZBrush writes what is painted into comments: "#MRGB" and for every vertex eight hexadecimal digits, of its mask,
  /// red, green and blue.
  void add_polypaint() {
    constexpr std::string_view tag = "#MRGB";
    std::vector<double> rgb, mask;
    for (std::size_t at = bytes_.find(tag); at != std::string_view::npos; at = bytes_.find(tag, at)) {
      at = std::min(bytes_.find_first_not_of(" \t", at + tag.size()), bytes_.size());
      for (std::uint32_t mrgb = 0; is_word(bytes_.substr(at, 8), mrgb); at += 8) {
        mask.push_back(mrgb >> 24);
        for (const int shift : {16, 8, 0}) rgb.push_back(mrgb >> shift & 0xff);
      }
    }
    if (mask.empty()) return;
    if (mask.size() != shape_.mesh.points.size() || !colored_.empty())
      return note("left-out",
                  counted(mask.size(), "colour") + " in #MRGB comments, " +
                      (colored_.empty() ? "not one for every vertex" : "beside those of the vertices") + "; left out",
                  mask.size());
    shape_.mesh.attributes.push_back(linear_color(std::move(rgb), 3, shape_.findings, NumberType::uint8));
    if (std::ranges::any_of(mask, [](double m) { return m != 255; }))
      shape_.mesh.attributes.push_back({"mask", 1, Domain::vertex, std::move(mask), NumberType::uint8});
  }

  static bool is_word(std::string_view digits, std::uint32_t& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return digits.size() == 8 && error == std::errc() && end == digits.data() + 8;
  }

  void add_corner_list(CornerList& list, const char* name) {
    const PolygonMesh& mesh = shape_.mesh;
    if (&list == &normal_) drop_beyond(list);
    const auto used = static_cast<std::size_t>(std::ranges::count_if(list.corners, [](auto i) { return i >= 0; }));
    if (used == 0) return;
    if (used < list.corners.size())
      note("corners-without-values",
           counted(list.corners.size() - used, "corner") + " without " + list.keyword + "; 0 there",
           list.corners.size() - used);
    Attribute a{name, static_cast<int>(list.components), Domain::corner, {}, NumberType::float64};
    a.values.reserve(list.components * list.corners.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_ends[f]; ++c) append(list, f, list.corners[c], a.values);
    shape_.mesh.attributes.push_back(std::move(a));
  }

  /// A shape without its normals is as good.
  void drop_beyond(CornerList& list) {
    std::size_t beyond = 0;
    for (std::int32_t& i : list.corners) {
      if (i < 0 || static_cast<std::size_t>(i) < list.size()) continue;
      i = -1;
      ++beyond;
    }
    if (beyond > 0) note("left-out", counted(beyond, "reference") + " to vn that are not there; left out", beyond);
  }

  static void append(const CornerList& list, std::size_t face, std::int32_t i, std::vector<double>& values) {
    if (i < 0) return values.resize(values.size() + list.components, 0.0);
    if (static_cast<std::size_t>(i) >= list.size())
      throw ShapeFault(ShapeFault::Element::face, face,
                       std::string("refers to ") + list.keyword + " " + std::to_string(i + 1LL) + ", but there are " +
                           std::to_string(list.size()));
    const auto first = list.values.begin() + static_cast<std::ptrdiff_t>(list.components) * i;
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(list.components));
  }

  void add_labels() {
    PolygonMesh& mesh = shape_.mesh;
    add_material_colors();
    if (object_.used()) mesh.attributes.push_back(std::move(object_).attribute("object"));
    if (group_.used()) mesh.attributes.push_back(std::move(group_).attribute("group"));
    if (material_.used()) mesh.attributes.push_back(std::move(material_).attribute("material"));
    if (smoothed_) mesh.attributes.push_back({"smoothing", 1, Domain::face, std::move(smoothing_), NumberType::int32});
  }

  /// "material_color" of the faces, where the libraries beside the file say any.
  void add_material_colors() {
    std::map<std::string, MtlMaterial> materials;
    for (const FileLink& link : shape_.mesh.links) read_mtl(path_, link.file, materials, shape_.findings);
    const auto colored = [&](const std::string& name) {
      const auto found = materials.find(name);
      return found != materials.end() && found->second.colored ? &found->second : nullptr;
    };
    if (std::ranges::none_of(material_.labels(), colored)) return;
    Attribute a{"material_color", 3, Domain::face, {}};
    for (const double value : material_.values()) {
      const MtlMaterial* m = colored(material_.labels()[static_cast<std::size_t>(value)]);
      const std::array<double, 3> color = m ? m->color : std::array<double, 3>{1, 1, 1};
      a.values.insert(a.values.end(), color.begin(), color.end());
    }
    shape_.mesh.attributes.push_back(std::move(a));
  }

  void report() {
    if (weights_ > 0) note("left-out", counted(weights_, "weight") + " of vertices; left out", weights_);
    if (extras_ > 0)
      note("left-out", counted(extras_, "vertex") + " with more numbers than x y z r g b; left out", extras_);
    if (depths_ > 0) note("left-out", counted(depths_, "third texture coordinate") + "; left out", depths_);
    if (uv_.size() > 0 && !shape_.mesh.find("uv")) note("left-out", "vt that no face refers to; left out", uv_.size());
    if (normal_.size() > 0 && !shape_.mesh.find("normal"))
      note("left-out", "vn that no face refers to; left out", normal_.size());
    if (left_out_.empty()) return;
    std::string words;
    std::size_t total = 0;
    for (const auto& [keyword, count] : left_out_) {
      total += count.count;
      if (words.size() < 200)
        words += (words.empty() ? "" : ", ") + std::to_string(count.count) + " x " + in_quotes(keyword) + " (line " +
                 std::to_string(count.line) + ")";
    }
    note("left-out", "statements that make no faces: " + words + "; left out", total);
  }

  struct Count {
    std::size_t count;
    int line;
  };

  std::string_view bytes_;
  TextScanner text_;
  const std::string& path_;
  RawShape shape_;
  std::vector<std::int32_t> colored_;  // vertices that have a colour
  std::vector<double> colors_;         // their r g b
  CornerList uv_{"vt", 2}, normal_{"vn", 3};
  FaceLabels object_, group_, material_;
  double smooth_ = 0;
  bool smoothed_ = false;
  std::vector<double> smoothing_;
  std::size_t weights_ = 0, depths_ = 0, extras_ = 0;
  std::map<std::string, Count> left_out_;
};

}  // namespace

RawShape read_obj(std::string_view bytes, const std::string& path) { return ObjReader(bytes, path).read(); }

}  // namespace pelage
