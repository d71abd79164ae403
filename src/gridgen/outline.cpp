#include "gridgen/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/box.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Twice the area of the triangle abc, positive when it is anticlockwise.
double turn_of(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The ends of an edge of a closed polygon.
struct Edge {
  const Point &a, &b;
};

Edge edge(const std::vector<Point>& polygon, std::size_t i) { return {polygon[i], polygon[(i + 1) % polygon.size()]}; }

bool boxes_meet(const Edge& p, const Edge& q) {
  for (std::size_t k = 0; k < 2; ++k)
    if (std::max(p.a[k], p.b[k]) < std::min(q.a[k], q.b[k]) || std::max(q.a[k], q.b[k]) < std::min(p.a[k], p.b[k]))
      return false;
  return true;
}

bool cross_each_other(const Edge& p, const Edge& q) {
  return boxes_meet(p, q) && turn_of(p.a, p.b, q.a) * turn_of(p.a, p.b, q.b) < 0 &&
         turn_of(q.a, q.b, p.a) * turn_of(q.a, q.b, p.b) < 0;
}

Point meeting(const Edge& p, const Edge& q) {
  const double from = turn_of(q.a, q.b, p.a), to = turn_of(q.a, q.b, p.b), t = from / (from - to);
  return {p.a[0] + t * (p.b[0] - p.a[0]), p.a[1] + t * (p.b[1] - p.a[1]), 0};
}

}  // namespace

double doubled_area(const std::vector<Point>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [a, b] = edge(polygon, i);
    sum += (a[0] - polygon[0][0]) * (b[1] - polygon[0][1]) - (a[1] - polygon[0][1]) * (b[0] - polygon[0][0]);
  }
  return sum;
}

std::optional<Crossing> first_crossing(const std::vector<Point>& polygon) {
  for (std::size_t j = 2; j < polygon.size(); ++j)
    for (std::size_t i = j + 1 == polygon.size() ? 1 : 0; i + 1 < j; ++i)
      if (cross_each_other(edge(polygon, i), edge(polygon, j)))
        return Crossing{i, j, meeting(edge(polygon, i), edge(polygon, j))};
  return {};
}

bool contains(const std::vector<Point>& polygon, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [a, b] = edge(polygon, i);
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

namespace {

/// What an outline may be cut at.
struct Candidate {
  double place = 0;  ///< share of the length
  double turn = 0;   ///< to the left, in right angles, at most 1
};

/// A closed curve at equal distances.
class EvenOutline {
 public:
  explicit EvenOutline(const Curve& outline) : samples_(sample(outline)) {
    std::vector<double> t;
    for (std::size_t i = 0; i < count; ++i) t.push_back(parameter(static_cast<double>(i) / count));
    points_ = outline.at(t);
  }

  double parameter(double share) const { return samples_.parameter(share * samples_.total()); }
  /// The same, or that of a knot less than a point away: drawn corners are there.
  double corner(double share) const;
  const Point& point(std::size_t i) const { return points_[i % count]; }

  /// In right angles, over a window on both sides: a drawn corner may be rounded a little.
  double turn(std::size_t i) const {
    const Point before = difference(point(i), point(i + count - window));
    const Point after = difference(point(i + window), point(i));
    return std::atan2(before[0] * after[1] - before[1] * after[0], dot(before, after)) / (std::numbers::pi / 2);
  }

  std::vector<Candidate> candidates() const;

  static constexpr std::size_t count = 400, window = 8;

 private:
  /// The places where the outline turns most among those around them.
  bool is_sharpest(std::size_t i) const {
    for (std::size_t k = 1; k <= window; ++k)
      if (turn(i + k) > turn(i) || turn(i + count - k) >= turn(i)) return false;
    return turn(i) > 0;
  }

  CurveSamples samples_;
  std::vector<Point> points_;
};

double EvenOutline::corner(double share) const {
  const auto away = [&](std::size_t knot) { return std::abs(samples_.length[knot] / samples_.total() - share); };
  const std::size_t nearest = *std::ranges::min_element(samples_.knots, {}, away);
  return away(nearest) * count < 1.5 ? samples_.t[nearest] : parameter(share);
}

/// The sharpest, and some evenly spaced ones for outlines without corners.
std::vector<Candidate> EvenOutline::candidates() const {
  constexpr std::size_t most_sharp = 14, even = 16;
  std::vector<Candidate> list;
  for (std::size_t i = 0; i < count; ++i)
    if (is_sharpest(i)) list.push_back({static_cast<double>(i) / count, std::min(1.0, turn(i))});
  std::ranges::stable_sort(list, std::greater{}, &Candidate::turn);
  if (list.size() > most_sharp) list.resize(most_sharp);
  for (std::size_t i = 0; i < count; i += count / even)
    list.push_back({static_cast<double>(i) / count, std::clamp(turn(i), -1.0, 1.0)});
  std::ranges::stable_sort(list, std::less{}, &Candidate::place);
  const auto near = [](const Candidate& a, const Candidate& b) { return b.place - a.place < 1e-9; };
  list.erase(std::unique(list.begin(), list.end(), near), list.end());
  return list;
}

/// How good four corners are: right angles, then opposite sides of like lengths, then a square.
double score(const std::array<Candidate, 4>& c) {
  double corners = 0;
  std::array<double, 4> side{};
  for (std::size_t k = 0; k < 4; ++k) {
    corners += c[k].turn;
    side[k] = k < 3 ? c[k + 1].place - c[k].place : c[0].place + 1 - c[3].place;
  }
  const auto unlike = [](double a, double b) { return std::abs(std::log(a / b)); };
  return corners - 0.5 * (unlike(side[0], side[2]) + unlike(side[1], side[3])) -
         0.1 * unlike(side[0] + side[2], side[1] + side[3]);
}

std::array<Candidate, 4> best_four(const std::vector<Candidate>& c) {
  std::array<Candidate, 4> best = {c[0], c[1], c[2], c[3]};
  double best_score = score(best);
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i + 1; j < c.size(); ++j)
      for (std::size_t k = j + 1; k < c.size(); ++k)
        for (std::size_t l = k + 1; l < c.size(); ++l) {
          const std::array<Candidate, 4> four = {c[i], c[j], c[k], c[l]};
          const double value = score(four);
          if (value > best_score + 1e-9) {
            best = four;
            best_score = value;
          }
        }
  return best;
}

}  // namespace

std::array<double, 4> find_corners(const Curve& outline) {
  const EvenOutline even(outline);
  const std::array<Candidate, 4> best = best_four(even.candidates());
  std::array<double, 4> parameters{};
  for (std::size_t k = 0; k < 4; ++k) parameters[k] = even.corner(best[k].place);
  const std::vector<Point> points = outline.at(parameters);
  const Box box = box_of(sample(outline).points);
  const auto lowest = std::ranges::min_element(
      points, {}, [&](const Point& p) { return std::hypot(p[0] - box.low[0], p[1] - box.low[1]); });
  std::rotate(parameters.begin(), parameters.begin() + (lowest - points.begin()), parameters.end());
  return parameters;
}

}  // namespace pelage
