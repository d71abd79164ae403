#include "shape/covered_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double area_of(const std::array<Point, 3>& t) {
  return length(cross(difference(t[1], t[0]), difference(t[2], t[0]))) / 2;
}

Point middle_of(const std::array<Point, 3>& t) {
  Point m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = (t[0][k] + t[1][k] + t[2][k]) / 3;
  return m;
}

Point on(const std::array<Point, 3>& t, const std::array<double, 2>& place) {
  Point p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = (1 - place[0] - place[1]) * t[0][k] + place[0] * t[1][k] + place[1] * t[2][k];
  return p;
}

double longest_edge(const std::array<Point, 3>& t) {
  return std::max({length(difference(t[0], t[1])), length(difference(t[1], t[2])), length(difference(t[2], t[0]))});
}

constexpr std::array<std::array<double, 2>, 3> whole_triangle = {{{0, 0}, {1, 0}, {0, 1}}};

/// At the midpoints of its edges.
std::array<CoveredParts::Piece, 4> quarters(const CoveredParts::Piece& piece) {
  const auto& [a, b, c] = piece.corner;
  const auto half = [](const std::array<double, 2>& p, const std::array<double, 2>& q) {
    return std::array{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
  };
  const auto ab = half(a, b), bc = half(b, c), ca = half(c, a);
  const std::int32_t f = piece.face;
  return {{{f, {a, ab, ca}}, {f, {ab, b, bc}}, {f, {ca, bc, c}}, {f, {bc, ca, ab}}}};
}

}  // namespace

std::shared_ptr<const CoveredParts> CoveredParts::of(std::shared_ptr<const TriangleMesh> mesh) {
  Enclosures enclosures(*mesh, soup_contacts(*mesh));
  if (!enclosures.any_meet()) return nullptr;
  const auto covered = std::shared_ptr<const CoveredParts>(new CoveredParts(std::move(mesh), std::move(enclosures)));
  return covered->share() > 0 ? covered : nullptr;
}

CoveredParts::CoveredParts(std::shared_ptr<const TriangleMesh> mesh, Enclosures enclosures)
    : mesh_(std::move(mesh)), enclosures_(std::move(enclosures)) {
  constexpr double same_place = 1e-5;  // of the box: files round by less, and patterns are larger
  hair_ = same_place * box_of(mesh_->points).diagonal();
  double whole = 0;
  const auto faces = static_cast<std::int32_t>(mesh_->triangles.size());
  for (std::int32_t f = 0; f < faces; ++f) whole += area_of(corners(f));
  small_ = std::sqrt(whole) / 128;
  for (std::int32_t f = 0; f < faces; ++f) {
    const std::size_t before = seen_.size();
    const bool near_others = split({f, whole_triangle}, corners(f), around(f)).near_others;
    state_.push_back(near_others ? State::mixed : seen_.size() > before ? State::seen : State::covered);
  }
  keep_whole_parts();
  double seen = 0;
  for (const Piece& p : seen_) seen += area_of(corners(p));
  constexpr double nothing = 1e-9;
  share_ = seen < (1 - nothing) * whole ? 1 - seen / whole : 0;
}

std::array<Point, 3> CoveredParts::corners(std::int32_t face) const {
  const Triangle& t = mesh_->triangles[at(face)];
  return {mesh_->points[at(t[0])], mesh_->points[at(t[1])], mesh_->points[at(t[2])]};
}

std::array<Point, 3> CoveredParts::corners(const Piece& piece) const {
  const std::array<Point, 3> t = corners(piece.face);
  return {on(t, piece.corner[0]), on(t, piece.corner[1]), on(t, piece.corner[2])};
}

/// Whether what lies a hair before a place, or behind it, is inside one of these parts with a number below `end`.
bool CoveredParts::inside_one_of(Parts others, std::int32_t face, const Point& p, double way, std::int32_t end) const {
  const std::array<Point, 3> t = corners(face);
  const Point n = unit(cross(difference(t[1], t[0]), difference(t[2], t[0])));
  Point there = p;
  for (std::size_t k = 0; k < 3; ++k) there[k] += way * n[k];
  return std::ranges::any_of(others,
                             [&](std::int32_t other) { return other < end && enclosures_.inside(other, there); });
}

bool CoveredParts::looks_covered(Parts others, std::int32_t face, const Point& p) const {
  return inside_one_of(others, face, p, hair_, std::numeric_limits<std::int32_t>::max()) ||
         inside_one_of(others, face, p, -hair_, enclosures_.part()[at(face)]);
}

bool CoveredParts::covers(std::int32_t face, const Point& p) const {
  const State state = state_[at(face)];
  return state == State::covered || (state == State::mixed && looks_covered(around(face), face, p));
}

/// Adds what is seen of a piece, which is one again if that is all of it. Of the parts that may cover some of it, those
/// whose surfaces do not pass by have all of it inside, or nothing: only the others are asked about its quarters.
CoveredParts::Split CoveredParts::split(const Piece& piece, const std::array<Point, 3>& corner, Parts others) {
  const Point middle = middle_of(corner);
  double reach = 2 * hair_;
  for (const Point& p : corner) reach = std::max(reach, 2 * hair_ + length(difference(p, middle)));
  std::vector<std::int32_t> near;
  for (const std::int32_t other : others)
    if (enclosures_.passes(other, middle, reach))
      near.push_back(other);
    else if (enclosures_.inside(other, middle))
      return {false, false};
  if (near.empty() || longest_edge(corner) <= small_) {
    const bool covered = looks_covered(near, piece.face, middle);
    if (!covered) seen_.push_back(piece);
    return {!near.empty(), !covered};
  }
  const std::size_t before = seen_.size();
  bool whole = true;
  for (const Piece& quarter : quarters(piece)) whole &= split(quarter, corners(quarter), near).whole;
  if (whole) {
    seen_.resize(before);
    seen_.push_back(piece);
  }
  return {true, whole};
}

/// Copies of what is seen are not among them.
void CoveredParts::keep_whole_parts() {
  std::vector<char> gone(enclosures_.parts(), 1);
  for (const Piece& p : seen_) gone[at(enclosures_.part()[at(p.face)])] = 0;
  for (std::int32_t f = 0; f < std::ssize(state_); ++f)
    if (char& g = gone[at(enclosures_.part()[at(f)])])
      g = inside_one_of(around(f), f, middle_of(corners(f)), hair_, std::numeric_limits<std::int32_t>::max());
  for (std::int32_t f = 0; f < std::ssize(state_); ++f) {
    if (!gone[at(enclosures_.part()[at(f)])]) continue;
    state_[at(f)] = State::seen;
    seen_.push_back({f, whole_triangle});
  }
}

}  // namespace pelage
