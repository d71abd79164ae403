#include "shape/winding_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/box.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

constexpr std::size_t leaf_size = 8;
constexpr double far = 2.5;  ///< radii, from where triangles count together: their second moments say 4 % then at most

/// Of a triangle as seen from a place (van Oosterom and Strackee 1983).
double solid_angle(const WindingTree::Corners& t, const Point& from) {
  const Point a = difference(t[0], from), b = difference(t[1], from), c = difference(t[2], from);
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

Point area_of(const WindingTree::Corners& t) {
  Point n = cross(difference(t[1], t[0]), difference(t[2], t[0]));
  for (double& x : n) x /= 2;
  return n;
}

double middle_of(const WindingTree::Corners& t, std::size_t k) { return (t[0][k] + t[1][k] + t[2][k]) / 3; }

}  // namespace

WindingTree::WindingTree(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) build(0, triangles_.size());
}

/// Halves the triangles at the median of their middles, along the longest side of their box.
void WindingTree::build(std::size_t begin, std::size_t end) {
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  Node node;
  Box box;
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const Point area = area_of(triangles_[i]);
    const double size = length(area);
    sum += size;
    for (std::size_t k = 0; k < 3; ++k) {
      node.area[k] += area[k];
      node.middle[k] += size * middle_of(triangles_[i], k);
    }
    for (const Point& p : triangles_[i]) box.add(p);
  }
  for (std::size_t k = 0; k < 3; ++k) node.middle[k] = sum > 0 ? node.middle[k] / sum : box.middle()[k];
  for (std::size_t i = begin; i < end; ++i)
    for (const Point& p : triangles_[i]) node.radius = std::max(node.radius, length(difference(p, node.middle)));
  if (end - begin <= leaf_size) {
    node.first = static_cast<std::int32_t>(begin);
    node.count = static_cast<std::int32_t>(end - begin);
    nodes_[number] = node;
    return;
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  const std::size_t half = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end),
                   [axis](const Corners& a, const Corners& b) { return middle_of(a, axis) < middle_of(b, axis); });
  build(begin, half);
  node.right = static_cast<std::int32_t>(nodes_.size());
  build(half, end);
  nodes_[number] = node;
}

double WindingTree::number(const Point& at) const {
  double sum = 0;
  std::vector<std::size_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::size_t number = open.back();
    open.pop_back();
    const Node& node = nodes_[number];
    const Point way = difference(node.middle, at);
    const double distance = length(way);
    if (distance > far * node.radius) {
      sum += dot(node.area, way) / (distance * distance * distance);
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
      sum += solid_angle(triangles_[static_cast<std::size_t>(i)], at);
    if (node.count > 0) continue;
    open.push_back(static_cast<std::size_t>(node.right));
    open.push_back(number + 1);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace pelage
