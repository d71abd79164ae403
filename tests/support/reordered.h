#pragma once
// The same shape in other numbers.

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage::testing {

/// 0, 1, ... in another order.
inline std::vector<std::int32_t> shuffled_numbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::int32_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::int32_t>(i);
  for (std::size_t i = count; i > 1; --i) std::swap(numbers[i - 1], numbers[random() % i]);
  return numbers;
}

struct Reordered {
  TriangleMesh mesh;
  std::vector<std::int32_t> vertex;  ///< per vertex of the original: its number here
};

/// Vertices and triangles in another order, triangles beginning with another corner. Without attributes.
inline Reordered reordered(const TriangleMesh& original, unsigned seed) {
  Reordered result{{original.points, {}, {}}, shuffled_numbers(original.points.size(), seed)};
  for (std::size_t v = 0; v < original.points.size(); ++v)
    result.mesh.points[static_cast<std::size_t>(result.vertex[v])] = original.points[v];
  for (const std::int32_t f : shuffled_numbers(original.triangles.size(), seed + 1)) {
    Triangle t = original.triangles[static_cast<std::size_t>(f)];
    for (auto& v : t) v = result.vertex[static_cast<std::size_t>(v)];
    const auto turn = static_cast<std::size_t>(f % 3);
    result.mesh.triangles.push_back({t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]});
  }
  return result;
}

/// Scaled, then moved.
inline TriangleMesh placed(TriangleMesh mesh, double scale, const Point& offset) {
  for (Point& p : mesh.points)
    for (std::size_t k = 0; k < 3; ++k) p[k] = scale * p[k] + offset[k];
  return mesh;
}

}  // namespace pelage::testing
