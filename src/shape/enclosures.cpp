#include "shape/enclosures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "shape/places.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Numbers that hang together have the least of them in common.
class Joined {
 public:
  explicit Joined(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t root(std::int32_t i) {
    while (up(i) != i) i = up(i) = up(up(i));
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = root(a), b = root(b);
    up(std::max(a, b)) = std::min(a, b);
  }

 private:
  std::int32_t& up(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<std::int32_t> parent_;
};

bool meet(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(a.low[k] <= b.high[k] && b.low[k] <= a.high[k])) return false;
  return true;
}

bool contains(const Box& box, const Point& p) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(box.low[k] <= p[k] && p[k] <= box.high[k])) return false;
  return true;
}

const Point& begin_of(const TriangleMesh& mesh, std::int32_t h) {
  return mesh.points[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(h / 3)][h % 3])];
}
const Point& end_of(const TriangleMesh& mesh, std::int32_t h) { return begin_of(mesh, h % 3 == 2 ? h - 2 : h + 1); }

/// Triangles from every rim of open half-edges to the middle of its corners.
void add_lids(const TriangleMesh& mesh, const std::vector<std::int32_t>& open, TriangleMesh& closed) {
  std::vector<Point> ends;
  for (const std::int32_t h : open) ends.insert(ends.end(), {begin_of(mesh, h), end_of(mesh, h)});
  const std::vector<std::int32_t> place = same_places(ends, std::vector<char>(ends.size(), 1));
  Joined rims(ends.size());
  for (std::size_t k = 0; k < open.size(); ++k) rims.join(place[2 * k], place[2 * k + 1]);
  struct Middle {
    Point sum{};
    double count = 0;
  };
  std::map<std::int32_t, Middle> middles;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    Middle& m = middles[rims.root(place[i])];
    for (std::size_t k = 0; k < 3; ++k) m.sum[k] += ends[i][k];
    ++m.count;
  }
  for (std::size_t k = 0; k < open.size(); ++k) {
    const Middle& m = middles[rims.root(place[2 * k])];
    const auto first = static_cast<std::int32_t>(closed.points.size());
    closed.points.insert(closed.points.end(),
                         {ends[2 * k + 1], ends[2 * k], {m.sum[0] / m.count, m.sum[1] / m.count, m.sum[2] / m.count}});
    closed.triangles.push_back({first, first + 1, first + 2});
  }
}

std::vector<WindingTree::Corners> corners_of(const TriangleMesh& mesh) {
  std::vector<WindingTree::Corners> corners;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
    corners.push_back({at(0), at(1), at(2)});
  }
  return corners;
}

/// From its first corner, so that it does not depend on where the shape lies.
double volume_of(const std::vector<WindingTree::Corners>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const Point& o = triangles[0][0];
    sum += dot(difference(a, o), cross(difference(b, o), difference(c, o))) / 6;
  }
  return sum;
}

/// The areas of a closed surface sum to 0 as vectors; those of pieces between edges of many faces do not.
bool is_balanced(const std::vector<WindingTree::Corners>& triangles) {
  constexpr double most = 0.05;
  Point sum{};
  double size = 0;
  for (const auto& [a, b, c] : triangles) {
    const Point area = cross(difference(b, a), difference(c, a));
    size += length(area);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += area[k];
  }
  return length(sum) <= most * size;
}

}  // namespace

Enclosures::Enclosures(const TriangleMesh& mesh, const SoupContacts& contacts) {
  number_parts(mesh, contacts);
  solid_.resize(parts());
  around_.resize(parts());
  if (parts() < 2) return;
  find_neighbours();
  std::vector<std::vector<std::int32_t>> faces(parts()), open(parts());
  for (std::size_t f = 0; f < part_.size(); ++f) faces[index(part_[f])].push_back(static_cast<std::int32_t>(f));
  for (const std::int32_t h : contacts.open) open[index(part_[index(h / 3)])].push_back(h);
  std::vector<char> done(parts(), 0);
  for (bool more = true; more;) {
    more = false;
    for (std::int32_t p = 0; p < std::ssize(solid_); ++p) {
      if (done[index(p)] || around_[index(p)].empty()) continue;
      std::vector<Point> openings;
      for (const std::int32_t h : open[index(p)]) openings.push_back(begin_of(mesh, h));
      if (!is_closed_by_others(p, openings)) continue;
      close(p, mesh, faces[index(p)], open[index(p)]);
      done[index(p)] = more = true;
    }
  }
  for (auto& others : around_) std::erase_if(others, [&](std::int32_t p) { return !solid_[index(p)]; });
}

bool Enclosures::any_meet() const {
  return std::ranges::any_of(around_, [](const auto& others) { return !others.empty(); });
}

void Enclosures::number_parts(const TriangleMesh& mesh, const SoupContacts& contacts) {
  Joined vertices(mesh.points.size());
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t v : t) vertices.join(t[0], v);
  for (std::size_t f = 0; f < contacts.of.size(); ++f)
    for (const SoupContact& c : contacts.of[f]) vertices.join(mesh.triangles[f][0], mesh.triangles[index(c.other)][0]);
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const Triangle& t : mesh.triangles) {
    std::int32_t& n = number[index(vertices.root(t[0]))];
    if (n < 0) {
      n = static_cast<std::int32_t>(box_.size());
      box_.emplace_back();
    }
    part_.push_back(n);
    for (const std::int32_t v : t) box_[index(n)].add(mesh.points[index(v)]);
  }
}

/// In order along x.
void Enclosures::find_neighbours() {
  std::vector<std::int32_t> order(parts());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](std::int32_t a, std::int32_t b) {
    const double xa = box_[index(a)].low[0], xb = box_[index(b)].low[0];
    return xa != xb ? xa < xb : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Box &a = box_[index(order[i])], &b = box_[index(order[k])];
      if (b.low[0] > a.high[0]) break;
      if (!meet(a, b)) continue;
      around_[index(order[i])].push_back(order[k]);
      around_[index(order[k])].push_back(order[i]);
    }
}

bool Enclosures::is_closed_by_others(std::int32_t part, const std::vector<Point>& openings) const {
  return std::ranges::all_of(openings, [&](const Point& p) {
    return std::ranges::any_of(around_[index(part)],
                               [&](std::int32_t other) { return solid_[index(other)] && inside(other, p); });
  });
}

void Enclosures::close(std::int32_t part, const TriangleMesh& mesh, const std::vector<std::int32_t>& faces,
                       const std::vector<std::int32_t>& open) {
  TriangleMesh closed;
  for (const std::int32_t f : faces) {
    const auto first = static_cast<std::int32_t>(closed.points.size());
    for (const std::int32_t v : mesh.triangles[index(f)]) closed.points.push_back(mesh.points[index(v)]);
    closed.triangles.push_back({first, first + 1, first + 2});
  }
  add_lids(mesh, open, closed);
  std::vector<WindingTree::Corners> corners = corners_of(closed);
  if (!is_balanced(corners)) return;
  const double volume = volume_of(corners);
  solid_[index(part)] =
      std::make_unique<const Solid>(Solid{DistanceTree(closed), WindingTree(std::move(corners)), volume});
}

bool Enclosures::inside(std::int32_t part, const Point& p) const {
  return contains(box_[index(part)], p) && std::abs(solid_[index(part)]->winding.number(p)) >= 0.5;
}

}  // namespace pelage
