#pragma once
// How often a surface winds around a point: the sum of the solid angles of its triangles over 4 pi, also where they do
// not quite fit together (Jacobson, Kavan and Sorkine-Hornung 2013). Triangles far away count together, as one with
// their summed area (Barill and others 2018).

#include <array>
#include <cstdint>
#include <vector>

#include "pelage/point.h"

namespace pelage {

class WindingTree {
 public:
  using Corners = std::array<Point, 3>;
  explicit WindingTree(std::vector<Corners> triangles);

  /// 1 inside a closed surface whose triangles are counter-clockwise from outside, 0 beyond it; within a few per cent
  /// away from the surface.
  double number(const Point& at) const;

 private:
  struct Node {
    Point middle{}, area{};  ///< weighted with areas; the sum of the areas as vectors
    double radius = 0;
    std::int32_t first = 0, count = 0;  ///< of its triangles; count 0: an inner node
    std::int32_t right = 0;             ///< the left child is the next node
  };
  void build(std::size_t begin, std::size_t end);

  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace pelage
