#include "gridgen/svg_path.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

#include "base/ascii.h"
#include "recipe/document.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// A stretch of a path, over a parameter from 0 to 1: straight, a cubic Bezier curve or a part of an ellipse.
struct Piece {
  enum class Kind { line, cubic, arc } kind = Kind::line;
  std::array<Point, 4> p = {};  ///< start, control points, end; of an arc the centre and the two half axes as vectors
  double from = 0, sweep = 0;   ///< angles of an arc
};

constexpr bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

Point combined(double a, const Point& p, double b, const Point& q) {
  return {a * p[0] + b * q[0], a * p[1] + b * q[1], 0};
}

Point at(const Piece& piece, double t) {
  const auto& p = piece.p;
  if (piece.kind == Piece::Kind::line) return combined(1 - t, p[0], t, p[3]);
  if (piece.kind == Piece::Kind::arc) {
    const double angle = piece.from + t * piece.sweep;
    return combined(1, p[0], 1, combined(std::cos(angle), p[1], std::sin(angle), p[2]));
  }
  const double s = 1 - t;
  return combined(1, combined(s * s * s, p[0], 3 * s * s * t, p[1]), 1, combined(3 * s * t * t, p[2], t * t * t, p[3]));
}

/// The half axes and the centre of the ellipse through two points (SVG 1.1, appendix F.6.5 and F.6.6).
Piece arc_piece(const Point& from, double rx, double ry, double degrees, bool large, bool sweep, const Point& to) {
  const double phi = degrees * std::numbers::pi / 180, c = std::cos(phi), s = std::sin(phi);
  const double dx = (from[0] - to[0]) / 2, dy = (from[1] - to[1]) / 2;
  const double x = c * dx + s * dy, y = -s * dx + c * dy;
  const double grown = std::sqrt(std::max(1.0, x * x / (rx * rx) + y * y / (ry * ry)));
  rx *= grown;
  ry *= grown;
  const double below = rx * rx * y * y + ry * ry * x * x;
  const double root = std::sqrt(std::max(0.0, rx * rx * ry * ry / below - 1)) * (large == sweep ? -1 : 1);
  const double cx = root * rx * y / ry, cy = -root * ry * x / rx;
  const double start = std::atan2((y - cy) / ry, (x - cx) / rx), end = std::atan2((-y - cy) / ry, (-x - cx) / rx);
  double angle = end - start;
  if (sweep && angle < 0) angle += 2 * std::numbers::pi;
  if (!sweep && angle > 0) angle -= 2 * std::numbers::pi;
  const Point centre = {c * cx - s * cy + (from[0] + to[0]) / 2, s * cx + c * cy + (from[1] + to[1]) / 2, 0};
  return {Piece::Kind::arc, {centre, {rx * c, rx * s, 0}, {-ry * s, ry * c, 0}, to}, start, angle};
}

/// Path data, character by character, with their places in the file.
class PathReader {
 public:
  explicit PathReader(const Formula& data) : data_(data) {}

  std::vector<Piece> read();
  bool closed() const { return closed_; }

 private:
  bool ended() {
    while (next_ < data_.text.size() && (is_blank(data_.text[next_]) || data_.text[next_] == ',')) ++next_;
    return next_ >= data_.text.size();
  }
  Location place() const;
  [[noreturn]] void refuse(const std::string& what) const { throw Error(Fault::usage, what, place()); }
  bool number_follows() {
    return !ended() &&
           (is_digit(data_.text[next_]) || std::string_view("+-.").find(data_.text[next_]) != std::string_view::npos);
  }
  double number();
  bool flag();
  Point point();
  void command(char letter);
  void repeat(char letter);
  void straight(const Point& to) { add({Piece::Kind::line, {here_, {}, {}, to}}); }
  void curve(const Point& a, const Point& b, const Point& to);
  void quadratic(const Point& a, const Point& to);
  void arc();
  void close();
  void add(Piece piece) {
    pieces_.push_back(piece);
    here_ = piece.p[3];
  }

  const Formula& data_;
  std::size_t next_ = 0;
  std::vector<Piece> pieces_;
  Point start_{}, here_{};
  std::optional<Point> control_;  ///< of the last curve, for S and T
  char last_ = 0;                 ///< the last command, as a capital
  bool relative_ = false, closed_ = false, begun_ = false;
};

Location PathReader::place() const {
  Location where = data_.where;
  for (std::size_t i = 0; i < std::min(next_, data_.text.size()); ++i) {
    if (data_.text[i] == '\n') {
      ++where.line;
      where.column = 1;
    } else {
      ++where.column;
    }
  }
  return where;
}

double PathReader::number() {
  if (!number_follows()) refuse("expected a number of the path data here");
  const char* begin = data_.text.data() + next_ + (data_.text[next_] == '+' ? 1 : 0);
  double value = 0;
  const auto [end, fault] = std::from_chars(begin, data_.text.data() + data_.text.size(), value);
  if (fault != std::errc{} || !std::isfinite(value)) refuse("expected a number of the path data here");
  next_ = static_cast<std::size_t>(end - data_.text.data());
  return value;
}

/// Flags of arcs may stand without a blank between them.
bool PathReader::flag() {
  if (ended() || (data_.text[next_] != '0' && data_.text[next_] != '1'))
    refuse("expected a flag of an arc here: 0 or 1");
  return data_.text[next_++] == '1';
}

Point PathReader::point() {
  const double x = number(), y = number();
  return relative_ ? Point{here_[0] + x, here_[1] + y, 0} : Point{x, y, 0};
}

void PathReader::curve(const Point& a, const Point& b, const Point& to) {
  add({Piece::Kind::cubic, {here_, a, b, to}});
  control_ = b;
}

void PathReader::quadratic(const Point& a, const Point& to) {
  add({Piece::Kind::cubic, {here_, combined(1. / 3, here_, 2. / 3, a), combined(1. / 3, to, 2. / 3, a), to}});
  control_ = a;
}

void PathReader::arc() {
  const double rx = std::abs(number()), ry = std::abs(number()), angle = number();
  const bool large = flag(), sweep = flag();
  const Point to = point();
  if (to == here_) return;
  if (rx == 0 || ry == 0) return straight(to);
  add(arc_piece(here_, rx, ry, angle, large, sweep, to));
}

void PathReader::close() {
  if (!(here_ == start_)) straight(start_);
  closed_ = true;
}

void PathReader::repeat(char letter) {
  const auto mirrored = [&](std::string_view after) {
    const bool follows = after.find(last_) != std::string_view::npos && control_;
    return follows ? combined(2, here_, -1, *control_) : here_;
  };
  if (letter == 'L') {
    straight(point());
  } else if (letter == 'H') {
    straight({number() + (relative_ ? here_[0] : 0), here_[1], 0});
  } else if (letter == 'V') {
    straight({here_[0], number() + (relative_ ? here_[1] : 0), 0});
  } else if (letter == 'C') {
    const Point a = point(), b = point();
    curve(a, b, point());
  } else if (letter == 'S') {
    const Point a = mirrored("CS"), b = point();
    curve(a, b, point());
  } else if (letter == 'Q') {
    const Point a = point();
    quadratic(a, point());
  } else if (letter == 'T') {
    const Point a = mirrored("QT");
    quadratic(a, point());
  } else {
    arc();
  }
  last_ = letter;
}

void PathReader::command(char letter) {
  const char capital = to_upper(letter);
  relative_ = letter != capital;
  if (std::string_view("MLHVCSQTAZ").find(capital) == std::string_view::npos)
    refuse(std::string("\"") + letter + "\" is no command of path data; known are M L H V C S Q T A Z");
  if (!begun_ && capital != 'M') refuse("path data begin with M");
  if (begun_ && (capital == 'M' || closed_)) refuse("the path has several subpaths; give one of them alone");
  ++next_;
  if (capital == 'Z') return close();
  if (capital == 'M') {
    here_ = start_ = point();
    begun_ = true;
    last_ = 'M';
    while (number_follows()) repeat('L');
    return;
  }
  do repeat(capital);
  while (number_follows());
}

std::vector<Piece> PathReader::read() {
  while (!ended()) command(data_.text[next_]);
  std::erase_if(pieces_, [](const Piece& p) { return p.kind == Piece::Kind::line && p.p[0] == p.p[3]; });
  if (pieces_.empty()) throw Error(Fault::usage, "the path has no extent; draw at least one line", data_.where);
  const Point begin = at(pieces_.front(), 0), end = at(pieces_.back(), 1);
  closed_ = closed_ || length(difference(begin, end)) < 1e-9 * (std::abs(begin[0]) + std::abs(begin[1]));
  return std::move(pieces_);
}

}  // namespace

SvgPath parse_svg_path(const Formula& data) {
  PathReader reader(data);
  const auto pieces = std::make_shared<const std::vector<Piece>>(reader.read());
  const double count = static_cast<double>(pieces->size());
  SvgPath path{{{}, {}, data.where}, reader.closed()};
  for (std::size_t i = 0; i <= pieces->size(); ++i) path.curve.knots.push_back(static_cast<double>(i) / count);
  path.curve.at = [pieces, count](std::span<const double> t) {
    std::vector<Point> points;
    for (const double s : t) {
      const double place = std::clamp(s, 0.0, 1.0) * count, piece = std::min(std::floor(place), count - 1);
      const Point p = at((*pieces)[static_cast<std::size_t>(piece)], place - piece);
      points.push_back({p[0], -p[1], 0});
    }
    return points;
  };
  return path;
}

namespace {

/// The value of an attribute in the text of a tag, and where it begins in that text.
std::optional<std::pair<std::string, std::size_t>> tag_attribute(std::string_view tag, const std::string& name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    std::size_t next = at + name.size();
    while (next < tag.size() && is_blank(tag[next])) ++next;
    if (at == 0 || !is_blank(tag[at - 1]) || next >= tag.size() || tag[next] != '=') continue;
    const std::size_t open = tag.find_first_of("\"'", next);
    if (open == std::string_view::npos) continue;
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == std::string_view::npos) continue;
    return std::pair(std::string(tag.substr(open + 1, close - open - 1)), open + 1);
  }
  return {};
}

Location place_in(std::string_view text, std::size_t offset, const std::string& file) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {file, static_cast<int>(std::ranges::count(before, '\n')) + 1, static_cast<int>(offset - line_start) + 1};
}

}  // namespace

Formula svg_file_path(const std::string& file, const std::string& id) {
  const std::string text = read_text(file);
  std::vector<Formula> found;
  for (std::size_t at = text.find("<path"); at != std::string::npos; at = text.find("<path", at + 1)) {
    const std::string_view tag = std::string_view(text).substr(at, text.find('>', at) - at);
    const auto name = tag_attribute(tag, "id"), data = tag_attribute(tag, "d");
    if (!data || (!id.empty() && (!name || name->first != id))) continue;
    if (tag_attribute(tag, "transform"))
      throw Error(Fault::input, "the path has a transform, which is not read; apply it to the path's points first",
                  place_in(text, at, file));
    found.push_back({data->first, place_in(text, at + data->second, file)});
  }
  const std::string which = id.empty() ? "" : " with the id \"" + id + "\"";
  if (found.empty()) throw Error(Fault::input, "has no path" + which, {file});
  if (found.size() > 1)
    throw Error(Fault::input, "has " + std::to_string(found.size()) + " paths" + which + "; name one by path = \"ID\"",
                {file});
  return found.front();
}

}  // namespace pelage
