#include "print/self_meeting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "print/exact_side.h"
#include "shape/closest_point.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using Corners = std::array<Point, 3>;

Point normal(const Corners& t) { return cross(difference(t[1], t[0]), difference(t[2], t[0])); }

// --- in a plane ---

/// Drops the coordinate along which the plane of these triangles is seen largest.
struct Projection {
  explicit Projection(const Corners& t) {
    const Point n = normal(t);
    std::size_t k = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (std::abs(n[d]) > std::abs(n[k])) k = d;
    x = (k + 1) % 3;
    y = (k + 2) % 3;
  }
  PlanePoint operator()(const Point& p) const { return {p[x], p[y]}; }
  std::size_t x, y;
};

bool between(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  for (std::size_t k = 0; k < 2; ++k)
    if (p[k] < std::min(a[k], b[k]) || p[k] > std::max(a[k], b[k])) return false;
  return true;
}

bool segments_meet(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  const int c_turn = turn(a, b, c), d_turn = turn(a, b, d), a_turn = turn(c, d, a), b_turn = turn(c, d, b);
  if (c_turn * d_turn < 0 && a_turn * b_turn < 0) return true;
  return (c_turn == 0 && between(c, a, b)) || (d_turn == 0 && between(d, a, b)) || (a_turn == 0 && between(a, c, d)) ||
         (b_turn == 0 && between(b, c, d));
}

/// In a triangle with an area.
bool lies_in(const PlanePoint& p, const std::array<PlanePoint, 3>& t) {
  if (turn(t[0], t[1], t[2]) == 0) return false;
  const int turns[] = {turn(t[0], t[1], p), turn(t[1], t[2], p), turn(t[2], t[0], p)};
  return std::ranges::all_of(turns, [](int s) { return s >= 0; }) ||
         std::ranges::all_of(turns, [](int s) { return s <= 0; });
}

bool meet_in_plane(const Point& p, const Point& q, const Corners& t) {
  const Projection flat(t);
  const std::array<PlanePoint, 3> corner{flat(t[0]), flat(t[1]), flat(t[2])};
  if (lies_in(flat(p), corner) || lies_in(flat(q), corner)) return true;
  for (std::size_t k = 0; k < 3; ++k)
    if (segments_meet(flat(p), flat(q), corner[k], corner[(k + 1) % 3])) return true;
  return false;
}

// --- in space ---

/// Of a segment and a triangle with an area, both with their ends.
bool segment_meets(const Point& p, const Point& q, const Corners& t) {
  const int p_side = side(t[0], t[1], t[2], p), q_side = side(t[0], t[1], t[2], q);
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) return meet_in_plane(p, q, t);
  bool left = true, right = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const int s = side(p, q, t[k], t[(k + 1) % 3]);
    left &= s >= 0;
    right &= s <= 0;
  }
  return left || right;
}

/// Of triangles that share no vertex.
bool triangles_meet(const Corners& s, const Corners& t) {
  for (std::size_t k = 0; k < 3; ++k)
    if (segment_meets(s[k], s[(k + 1) % 3], t) || segment_meets(t[k], t[(k + 1) % 3], s)) return true;
  return false;
}

/// Of triangles with a common edge, whose other corners are p and q: whether one is folded onto the other.
bool folded(const Point& a, const Point& b, const Point& p, const Point& q) {
  if (dot(normal({a, b, p}), normal({a, b, q})) <= 0 || side(a, b, p, q) != 0) return false;
  const Projection flat({a, b, p});
  return turn(flat(a), flat(b), flat(p)) == turn(flat(a), flat(b), flat(q));
}

}  // namespace

bool meet(const Triangle& s, const Triangle& t, const std::vector<Point>& points) {
  const auto at = [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
  const Corners a{at(s[0]), at(s[1]), at(s[2])}, b{at(t[0]), at(t[1]), at(t[2])};
  if (normal(a) == Point{} || normal(b) == Point{}) return false;
  const auto in = [](std::int32_t v, const Triangle& other) { return std::ranges::count(other, v) > 0; };
  const auto common = std::ranges::count_if(s, [&](std::int32_t v) { return in(v, t); });
  if (common == 0) return triangles_meet(a, b);
  if (common == 3) return true;
  // The corner of each that is alone, or the only one that both have.
  std::size_t i = 0, j = 0;
  while (in(s[i], t) != (common == 1)) ++i;
  while (in(t[j], s) != (common == 1)) ++j;
  if (common == 2) return folded(a[(i + 1) % 3], a[(i + 2) % 3], a[i], b[j]);
  return segment_meets(a[(i + 1) % 3], a[(i + 2) % 3], b) || segment_meets(b[(j + 1) % 3], b[(j + 2) % 3], a);
}

Point middle_of(const Triangle& t, const std::vector<Point>& points) {
  Point sum{};
  for (const std::int32_t v : t)
    for (std::size_t d = 0; d < 3; ++d) sum[d] += points[static_cast<std::size_t>(v)][d] / 3;
  return sum;
}

std::vector<Meeting> self_meetings(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                                   std::span<const char> asked) {
  const DistanceTree tree({points, triangles, {}});
  const auto is_asked = [&](std::size_t t) { return asked.empty() || asked[t]; };
  constexpr std::size_t chunk = 256;
  std::vector<std::vector<Meeting>> found(chunk_count(triangles.size(), chunk));
  parallel_for(
      triangles.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
          if (!is_asked(t)) continue;
          Box box;
          for (const std::int32_t v : triangles[t]) box.add(points[static_cast<std::size_t>(v)]);
          tree.for_each_in(box, [&](std::int32_t other) {
            const auto o = static_cast<std::size_t>(other);
            if (o == t || (o < t && is_asked(o)) || !meet(triangles[t], triangles[o], points)) return;
            const auto number = static_cast<std::int32_t>(t);
            found[begin / chunk].push_back({std::min(number, other), std::max(number, other)});
          });
        }
      },
      chunk);
  std::vector<Meeting> all;
  for (const std::vector<Meeting>& some : found) all.insert(all.end(), some.begin(), some.end());
  std::ranges::sort(all, [](const Meeting& a, const Meeting& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return all;
}

}  // namespace pelage
