#pragma once
// Distances to a triangle mesh, by a tree of boxes.

#include <cstdint>
#include <utility>
#include <vector>

#include "base/box.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

class DistanceTree {
 public:
  /// Copies what it needs.
  explicit DistanceTree(const TriangleMesh& mesh);

  /// Distance from a point to the nearest point of any triangle; infinite for a mesh without triangles.
  double distance(const Point& from) const;
  /// The number of the nearest triangle, the first of several; -1 for a mesh without triangles.
  std::int32_t nearest(const Point& from) const;
  bool any_within(const Point& from, double radius) const;
  /// The numbers of all triangles within a radius, in ascending order.
  std::vector<std::int32_t> within(const Point& from, double radius) const;
  /// Calls visit(number) for all triangles whose boxes meet that one; always in the same order.
  template <class Visit>
  void for_each_in(const Box& box, Visit&& visit) const;

 private:
  struct Node {
    Box box;
    std::int32_t first = 0, count = 0;  ///< of its triangles; count 0: an inner node
    std::int32_t right = 0;             ///< the left child is the next node
  };
  void build(std::size_t begin, std::size_t end);
  std::pair<double, std::int32_t> search(const Point& from) const;
  template <class Visit>
  void for_each_within(const Point& from, double radius, Visit&& visit) const;

  struct Corners {
    std::array<Point, 3> corner;
    std::int32_t number;
    double square_distance(const Point& from) const;
  };
  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

inline bool boxes_meet(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] || a.high[k] < b.low[k]) return false;
  return true;
}

template <class Visit>
void DistanceTree::for_each_in(const Box& box, Visit&& visit) const {
  std::vector<std::int32_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::int32_t number = open.back();
    open.pop_back();
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (!boxes_meet(box, node.box)) continue;
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& triangle = triangles_[static_cast<std::size_t>(i)];
      if (boxes_meet(box, box_of(triangle.corner))) visit(triangle.number);
    }
    if (node.count > 0) continue;
    open.push_back(number + 1);
    open.push_back(node.right);
  }
}

/// Square of the distance from p to the triangle a b c, degenerate ones included.
double square_distance(const Point& p, const Point& a, const Point& b, const Point& c);

/// The place (v, w) of the nearest point (1-v-w) a + v b + w c of the triangle.
std::array<double, 2> closest_place(const Point& p, const Point& a, const Point& b, const Point& c);

}  // namespace pelage
