#include "shape/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/vectors.h"

namespace pelage {

namespace {

constexpr std::size_t leaf_size = 8;  ///< triangles; below this a search is as fast as another level
constexpr double infinity = std::numeric_limits<double>::infinity();

double square(const Point& a) { return dot(a, a); }

double square_distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point ab = difference(b, a), ap = difference(p, a);
  const double length2 = square(ab);
  const double t = length2 > 0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0;
  return square({ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]});
}

Point middle(const std::array<Point, 3>& t) {
  return {t[0][0] + t[1][0] + t[2][0], t[0][1] + t[1][1] + t[2][1], t[0][2] + t[1][2] + t[2][2]};
}

double square_distance(const Box& box, const Point& from) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double outside = std::max({box.low[k] - from[k], from[k] - box.high[k], 0.0});
    sum += outside * outside;
  }
  return sum;
}

}  // namespace

double square_distance(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point n = cross(difference(b, a), difference(c, a));
  const double n2 = square(n);
  const auto inside = [&](const Point& from, const Point& to) {
    return dot(cross(difference(to, from), difference(p, from)), n) >= 0;
  };
  if (n2 > 0 && inside(a, b) && inside(b, c) && inside(c, a)) {
    const double height = dot(difference(p, a), n);
    return height * height / n2;
  }
  return std::min(
      {square_distance_to_segment(p, a, b), square_distance_to_segment(p, b, c), square_distance_to_segment(p, c, a)});
}

std::array<double, 2> closest_place(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point e = difference(b, a), f = difference(c, a), g = difference(p, a);
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), ge = dot(g, e), gf = dot(g, f);
  const double determinant = ee * ff - ef * ef;
  if (determinant > 0) {
    const double v = (ff * ge - ef * gf) / determinant, w = (ee * gf - ef * ge) / determinant;
    if (v >= 0 && w >= 0 && v + w <= 1) return {v, w};
  }
  const auto fraction = [](double along, double length2) {
    return length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  };
  const double third = fraction(gf - ge + ee - ef, ee - 2 * ef + ff);
  std::array<double, 2> best{};
  double least = infinity;
  for (const auto& [v, w] : {std::array{fraction(ge, ee), 0.0}, {0.0, fraction(gf, ff)}, {1 - third, third}}) {
    const double square = v * v * ee + 2 * v * w * ef + w * w * ff - 2 * (v * ge + w * gf);
    if (square >= least) continue;
    least = square;
    best = {v, w};
  }
  return best;
}

double DistanceTree::Corners::square_distance(const Point& from) const {
  return pelage::square_distance(from, corner[0], corner[1], corner[2]);
}

DistanceTree::DistanceTree(const TriangleMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    triangles_.push_back(
        {{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, static_cast<std::int32_t>(triangles_.size())});
  if (!triangles_.empty()) build(0, triangles_.size());
}

/// Halves the triangles at the median of their middles, along the longest side of the box.
void DistanceTree::build(std::size_t begin, std::size_t end) {
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  Box box;
  for (std::size_t i = begin; i < end; ++i)
    for (const Point& p : triangles_[i].corner) box.add(p);
  nodes_[number].box = box;
  if (end - begin <= leaf_size) {
    nodes_[number].first = static_cast<std::int32_t>(begin);
    nodes_[number].count = static_cast<std::int32_t>(end - begin);
    return;
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  const std::size_t half = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end),
                   [axis](const auto& a, const auto& b) { return middle(a.corner)[axis] < middle(b.corner)[axis]; });
  build(begin, half);
  nodes_[number].right = static_cast<std::int32_t>(nodes_.size());
  build(half, end);
}

/// The square of the distance and the number of the nearest triangle.
std::pair<double, std::int32_t> DistanceTree::search(const Point& from) const {
  std::pair<double, std::int32_t> best = {infinity, -1};
  std::vector<std::int32_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::int32_t number = open.back();
    open.pop_back();
    const Node& node = nodes_[number];
    if (square_distance(node.box, from) > best.first) continue;
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const std::pair here = {triangles_[i].square_distance(from), triangles_[i].number};
      if (best.second < 0 || here < best) best = here;
    }
    if (node.count > 0) continue;
    const std::int32_t left = number + 1;
    const bool left_first = square_distance(nodes_[left].box, from) <= square_distance(nodes_[node.right].box, from);
    open.push_back(left_first ? node.right : left);
    open.push_back(left_first ? left : node.right);
  }
  return best;
}

double DistanceTree::distance(const Point& from) const { return std::sqrt(search(from).first); }
std::int32_t DistanceTree::nearest(const Point& from) const { return search(from).second; }

/// Calls visit(number) for the triangles within a radius, until it returns false.
template <class Visit>
void DistanceTree::for_each_within(const Point& from, double radius, Visit&& visit) const {
  std::vector<std::int32_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::int32_t number = open.back();
    open.pop_back();
    const Node& node = nodes_[number];
    if (square_distance(node.box, from) > radius * radius) continue;
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
      if (triangles_[i].square_distance(from) <= radius * radius && !visit(triangles_[i].number)) return;
    if (node.count > 0) continue;
    open.push_back(node.right);
    open.push_back(number + 1);
  }
}

bool DistanceTree::any_within(const Point& from, double radius) const {
  bool any = false;
  for_each_within(from, radius, [&](std::int32_t) { return !(any = true); });
  return any;
}

std::vector<std::int32_t> DistanceTree::within(const Point& from, double radius) const {
  std::vector<std::int32_t> found;
  for_each_within(from, radius, [&](std::int32_t number) {
    found.push_back(number);
    return true;
  });
  std::ranges::sort(found);
  return found;
}

}  // namespace pelage
