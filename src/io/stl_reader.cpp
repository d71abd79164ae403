#include "io/stl_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <utility>

#include "base/ascii.h"
#include "base/srgb.h"
#include "io/text_scanner.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read in the machine's order");

constexpr std::size_t header_size = 84, facet_size = 50;
/// Some programs pad or sign their files; more than this behind the facets means that it is no STL file.
constexpr std::size_t most_trailing = 4096;

std::uint64_t binary_size(std::string_view bytes) {
  std::uint32_t facets = 0;
  std::memcpy(&facets, bytes.data() + 80, sizeof facets);
  return header_size + facet_size * static_cast<std::uint64_t>(facets);
}

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool starts_with_word(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(), [](char a, char b) { return a == to_lower(b); });
}

void note_trailing(RawShape& shape, std::size_t count) {
  shape.findings.push_back(
      {"data-behind-the-end", counted(count, "byte") + " behind the last facet; skipped", count, 0, false});
}

/// Whether the text form's frame is there; many binary files begin with "solid", too.
bool looks_like_text(std::string_view bytes) {
  if (bytes.size() >= header_size && binary_size(bytes) == bytes.size()) return false;
  std::size_t at = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while (at < bytes.size() && is_space(bytes[at])) ++at;
  const std::string_view start = bytes.substr(at, 512);
  const bool printable =
      std::ranges::none_of(start.substr(0, 80), [](char c) { return c >= 0 && c < ' ' && !is_space(c); });
  return printable && (starts_with_word(start, "solid") || starts_with_word(start, "facet"));
}

// --- binary ---

/// What the two attribute bytes of the facets mean: nothing that the format says, but two conventions are common.
class FacetColors {
 public:
  /// Magics writes COLOR= and four bytes into the header, the colour of facets whose bit 15 is set; others have 5 bits
  /// each of blue, green and red, from the highest. Everyone else has them the other way round, with bit 15 set.
  explicit FacetColors(std::string_view header) : magics_(header.find("COLOR=")) {
    if (magics_ == std::string_view::npos || magics_ + 10 > header.size()) return;
    for (std::size_t k = 0; k < 3; ++k) whole_[k] = static_cast<unsigned char>(header[magics_ + 6 + k]);
  }

  void add(std::uint16_t bits) {
    bits_.push_back(bits);
    flagged_ += bits >> 15;
    other_ += bits != 0 && bits >> 15 == 0;
  }

  void finish(RawShape& shape) {
    if (magics_ == std::string_view::npos && flagged_ == 0) {
      if (other_ > 0)
        shape.findings.push_back({"attribute-bytes",
                                  counted(other_, "facet") + " with attribute bytes that are no colours; left out",
                                  other_, 0, false});
      return;
    }
    const bool magics = magics_ != std::string_view::npos;
    Attribute color{"color", 3, Domain::face, {}, NumberType::uint8};
    color.values.reserve(3 * bits_.size());
    for (const std::uint16_t bits : bits_)
      for (std::size_t k = 0; k < 3; ++k)
        color.values.push_back(linear_from_srgb(magics ? of_magics(bits, k) : plain(bits, k)));
    if (!magics && flagged_ < bits_.size())
      shape.findings.push_back({"facets-without-colour",
                                counted(bits_.size() - flagged_, "facet") + " without a colour; white there",
                                bits_.size() - flagged_, 0, false});
    shape.mesh.attributes.push_back(std::move(color));
  }

 private:
  static double five_bits(std::uint16_t bits, std::size_t place) { return ((bits >> (5 * place)) & 31) / 31.0; }
  double of_magics(std::uint16_t bits, std::size_t k) const {
    return bits >> 15 ? whole_[k] / 255.0 : five_bits(bits, k);
  }
  static double plain(std::uint16_t bits, std::size_t k) { return bits >> 15 ? five_bits(bits, 2 - k) : 1; }

  std::size_t magics_;
  std::array<int, 3> whole_ = {255, 255, 255};
  std::vector<std::uint16_t> bits_;
  std::size_t flagged_ = 0, other_ = 0;
};

void note_header(std::string_view header, RawShape& shape) {
  if (header.find("MATERIAL=") != std::string_view::npos)
    shape.findings.push_back({"left-out", "the material of the header; left out", 1, 0, false});
}

/// The winding says where outside is; a normal that says otherwise is noted.
void count_turned(const RawShape& shape, const Point& normal, Finding& turned) {
  const std::vector<Point>& p = shape.mesh.points;
  const std::size_t n = p.size();
  const Point wound = cross(difference(p[n - 2], p[n - 3]), difference(p[n - 1], p[n - 3]));
  if (dot(normal, wound) < 0 && turned.count++ == 0) turned.element = shape.mesh.face_count() - 1;
}

void report_turned(RawShape& shape, Finding turned) {
  if (turned.count == 0) return;
  turned.text = counted(turned.count, "normal") + " against the order of the corners (first: face " +
                std::to_string(turned.element) + "); the order counts";
  shape.findings.push_back(turned);
}

/// Whole facets that the header does not count are no padding either.
bool is_more_than_padding(std::uint64_t trailing) {
  return trailing > most_trailing || (trailing > 0 && trailing % facet_size == 0);
}

RawShape read_binary(std::string_view bytes, const std::string& path) {
  if (bytes.size() < header_size)
    throw Error(Fault::input, "is no STL file: too short for a binary one, and a text one begins with \"solid\"",
                {path});
  const std::uint64_t promised = binary_size(bytes);
  const std::size_t facets = (promised - header_size) / facet_size;
  if (promised > bytes.size() || facets == 0 || is_more_than_padding(bytes.size() - promised))
    throw Error(Fault::input,
                "the header promises " + std::to_string(facets) + " facets (" + std::to_string(promised) +
                    " bytes), but the file has " + std::to_string(bytes.size()) +
                    " bytes; it is damaged or no STL file",
                {path});
  RawShape shape;
  Finding turned{"turned-normals", "", 0, 0, false};
  FacetColors colors(bytes.substr(0, 80));
  shape.mesh.points.reserve(3 * facets);
  for (std::size_t f = 0; f < facets; ++f) {
    float values[12];  // normal and three corners
    std::uint16_t bits = 0;
    const char* facet = bytes.data() + header_size + f * facet_size;
    std::memcpy(values, facet, sizeof values);
    std::memcpy(&bits, facet + sizeof values, sizeof bits);
    for (int c = 3; c < 12; c += 3) {
      shape.mesh.corners.push_back(static_cast<std::int32_t>(shape.mesh.points.size()));
      shape.mesh.points.push_back({values[c], values[c + 1], values[c + 2]});
    }
    shape.mesh.end_face();
    count_turned(shape, {values[0], values[1], values[2]}, turned);
    colors.add(bits);
  }
  colors.finish(shape);
  note_header(bytes.substr(0, 80), shape);
  report_turned(shape, turned);
  if (promised < bytes.size()) note_trailing(shape, bytes.size() - promised);
  return shape;
}

// --- text ---

/// Programs break lines where they like, leave blanks out ("endsolidcube") or put them in ("end facet"), and write
/// capitals: so keywords are looked for where they can stand, and only the name of a solid ends with its line.
class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& path) : text_(bytes), path_(path) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  RawShape read() {
    while (next_statement()) {
    }
    report_turned(shape_, turned_);
    if (in_solid_)
      shape_.findings.push_back(
          {"no-end", "no endsolid behind the last facet; the file may be cut short", 1, 0, false});
    if (labels_.empty()) return std::move(shape_);
    if (labels_.size() > 1 || !labels_.front().empty()) shape_.mesh.attributes.push_back(object());
    return std::move(shape_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Error(Fault::input, message, {path_, line_}); }

  void skip_space() {
    for (; at_ < text_.size() && is_space(text_[at_]); ++at_)
      line_ += text_[at_] == '\n' || (text_[at_] == '\r' && (at_ + 1 == text_.size() || text_[at_ + 1] != '\n'));
  }

  /// Takes a keyword, which need not end with a blank.
  bool take(std::string_view keyword) {
    skip_space();
    if (!starts_with_word(text_.substr(at_), keyword)) return false;
    at_ += keyword.size();
    return true;
  }

  /// "endfacet" or "end facet".
  bool take_end(std::string_view of) {
    const std::size_t at = at_;
    const int line = line_;
    if (take("end") && take(of)) return true;
    at_ = at;
    line_ = line;
    return false;
  }

  std::string_view word() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void expect(bool taken, const char* what) {
    if (taken) return;
    skip_space();
    if (at_ == text_.size()) fail(std::string("the file ends where \"") + what + "\" should be; it is cut short");
    fail(std::string("expected \"") + what + "\", found " + in_quotes(word()) + "; the file is damaged or no STL file");
  }

  bool next_statement() {
    skip_space();
    if (at_ == text_.size()) return false;
    if (take_end("solid")) return end_solid();
    if (take("solid"))
      begin_solid();
    else if (take("facet") || starts_with_word(text_.substr(at_), "outer"))
      facet();
    else
      return end_of_text();
    return true;
  }

  /// The name reaches to the end of the line, or to a facet on the same line.
  std::string_view name() {
    constexpr std::size_t longest = 4096;  // a file without line ends must not be looked through for every solid
    std::string_view line = text_.substr(at_, longest);
    line = line.substr(0, line.find_first_of("\r\n"));
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (!starts_with_word(line.substr(i), "facet") || !starts_facet(line.substr(i))) continue;
      line = line.substr(0, i);
      break;
    }
    at_ += line.size();
    while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
    return line;
  }

  /// "facet normal 0": a name may have these words, but no number behind them.
  static bool starts_facet(std::string_view rest) {
    TextScanner text(rest, "");
    text.word();
    const std::string_view normal = text.word();
    if (!starts_with_word(normal, "normal")) return false;
    const std::string_view number = normal.size() > 6 ? normal.substr(6) : text.word();
    return !number.empty() && std::string_view("+-.0123456789").find(number[0]) != std::string_view::npos;
  }

  void begin_solid() {
    labels_.emplace_back(name());
    in_solid_ = true;
  }

  /// Where a facet follows, the next solid begins on the same line: "endsolid a solid b".
  bool end_solid() {
    const std::string_view line = name();
    in_solid_ = false;
    skip_space();
    const std::size_t next = line.rfind("solid");
    if (next != std::string_view::npos && starts_with_word(text_.substr(at_), "facet")) {
      std::string_view label = line.substr(next + 5);
      while (!label.empty() && is_space(label.front())) label.remove_prefix(1);
      labels_.emplace_back(label);
      in_solid_ = true;
    }
    return true;
  }

  bool end_of_text() {
    if (in_solid_ || shape_.mesh.face_count() == 0)
      fail("unexpected word " + in_quotes(word()) + "; the file is damaged or no STL file");
    note_trailing(shape_, text_.size() - at_);
    return false;
  }

  /// Some programs leave out the lines around the loop.
  void facet() {
    if (labels_.empty()) labels_.emplace_back();
    solid_.push_back(static_cast<double>(labels_.size() - 1));
    const Point said = take("normal") ? normal() : Point{};
    expect(take("outer") && take("loop"), "outer loop");
    shape_.face_lines.push_back(line_);
    while (take("vertex")) vertex();
    expect(take_end("loop"), "endloop");
    shape_.mesh.end_face();
    take_end("facet");
    if (shape_.mesh.face_size(shape_.mesh.face_count() - 1) == 3) count_turned(shape_, said, turned_);
  }

  double coordinate() {
    const int line = line_;
    const std::string_view text = word();
    double x = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (code == std::errc() && end == text.data() + text.size() && !text.empty()) return x;
    return TextScanner(text, path_, text.empty() ? line : line_).number(text, "a coordinate");  // says what is wrong
  }

  /// Only looked at to be compared: programs write things like -nan(ind).
  Point normal() {
    Point p{};
    for (double& x : p) {
      skip_space();
      if (starts_with_word(text_.substr(at_), "outer")) break;
      const std::string_view text = word();
      std::from_chars(text.data(), text.data() + text.size(), x);
    }
    return p;
  }

  void vertex() {
    shape_.vertex_lines.push_back(line_);
    shape_.mesh.corners.push_back(static_cast<std::int32_t>(shape_.mesh.points.size()));
    Point p;
    for (double& x : p) x = coordinate();
    shape_.mesh.points.push_back(p);
  }

  Attribute object() {
    for (std::size_t i = 0; i < labels_.size(); ++i)
      if (labels_[i].empty()) labels_[i] = "solid " + std::to_string(i + 1);
    return {"object", 1, Domain::face, std::move(solid_), NumberType::int32, std::move(labels_)};
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
  int line_ = 1;
  RawShape shape_;
  std::vector<std::string> labels_;  // of the solids so far
  std::vector<double> solid_;        // per facet
  bool in_solid_ = false;
  Finding turned_{"turned-normals", "", 0, 0, false};
};

}  // namespace

RawShape read_stl(std::string_view bytes, const std::string& path) {
  return looks_like_text(bytes) ? TextReader(bytes, path).read() : read_binary(bytes, path);
}

}  // namespace pelage
