#pragma once
// Distances to a triangle mesh, by a tree of boxes.

#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

class DistanceTree {
 public:
  /// Copies what it needs.
  explicit DistanceTree(const TriangleMesh& mesh);

  /// Distance from a point to the nearest point of any triangle; infinite for a mesh without triangles.
  double distance(const Point& from) const;
  /// The numbers of all triangles within a radius, in ascending order.
  std::vector<std::int32_t> within(const Point& from, double radius) const;

 private:
  struct Box {
    Point low, high;
    double square_distance(const Point& from) const;
  };
  struct Node {
    Box box;
    std::int32_t first = 0, count = 0;  ///< of its triangles; count 0: an inner node
    std::int32_t right = 0;             ///< the left child is the next node
  };
  void build(std::size_t begin, std::size_t end);

  struct Corners {
    std::array<Point, 3> corner;
    std::int32_t number;
    double square_distance(const Point& from) const;
  };
  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

/// Square of the distance from p to the triangle a b c, degenerate ones included.
double square_distance(const Point& p, const Point& a, const Point& b, const Point& c);

/// The place (v, w) of the nearest point (1-v-w) a + v b + w c of the triangle.
std::array<double, 2> closest_place(const Point& p, const Point& a, const Point& b, const Point& c);

}  // namespace pelage
