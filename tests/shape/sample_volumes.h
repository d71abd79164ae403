#pragma once
// Volumes for tests, and what holds of all.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "pelage/tet_mesh.h"
#include "shape/solid_cells.h"
#include "shape/vectors.h"

namespace pelage::test {

/// Numbers that look like chance, the same everywhere.
class Chance {
 public:
  std::uint32_t below(std::uint32_t n) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint32_t>(state_ >> 33) % n;
  }
  double between(double low, double high) { return low + (high - low) * below(1U << 20) / double(1U << 20); }

 private:
  std::uint64_t state_ = 12345;
};

/// A unit cube of n x n x n hexahedra, whose nodes have numbers by chance; inner nodes are moved by up to `shift`
/// cells.
inline SolidCells cube_of_hexahedra(int n, double shift = 0) {
  Chance chance;
  const int m = n + 1;
  std::vector<std::int32_t> number(static_cast<std::size_t>(m * m * m));
  std::iota(number.begin(), number.end(), 0);
  for (std::size_t i = number.size() - 1; i > 0; --i) std::swap(number[i], number[chance.below(std::uint32_t(i + 1))]);
  const auto node = [&](int i, int j, int k) { return number[static_cast<std::size_t>(i + m * (j + m * k))]; };
  SolidCells cells;
  cells.points.resize(number.size());
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) {
        Point p = {double(i) / n, double(j) / n, double(k) / n};
        for (double& x : p)
          if (i % n != 0 && j % n != 0 && k % n != 0) x += chance.between(-shift, shift) / n;
        cells.points[static_cast<std::size_t>(node(i, j, k))] = p;
      }
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        cells.cells.push_back(
            {CellShape::hexahedron,
             {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
              node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)}});
  return cells;
}

inline TetMesh cube_of_tets(int n, double shift = 0) {
  std::vector<Finding> findings;
  return tets_of(cube_of_hexahedra(n, shift), findings);
}

inline double volume(const TetMesh& v, const Tetrahedron& t) {
  const auto edge = [&](std::size_t k) {
    return difference(v.points[static_cast<std::size_t>(t[k])], v.points[static_cast<std::size_t>(t[0])]);
  };
  return dot(cross(edge(1), edge(2)), edge(3)) / 6;
}

inline double volume(const TetMesh& v) {
  double sum = 0;
  for (const Tetrahedron& t : v.tets) sum += volume(v, t);
  return sum;
}

inline Point area_vector(const TriangleMesh& mesh, const Triangle& t) {
  const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
  Point a = cross(difference(at(1), at(0)), difference(at(2), at(0)));
  for (double& x : a) x /= 2;
  return a;
}

inline double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += length(area_vector(mesh, t));
  return sum;
}

/// What the surface encloses, by the divergence theorem.
inline double enclosed(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += dot(mesh.points[static_cast<std::size_t>(t[0])], area_vector(mesh, t)) / 3;
  return sum;
}

/// Edges that are not there exactly once in each direction.
inline std::size_t open_edges(const TriangleMesh& mesh) {
  std::map<std::array<std::int32_t, 2>, std::array<int, 2>> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3];
      ++edges[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
    }
  return static_cast<std::size_t>(std::ranges::count_if(edges, [](const auto& entry) {
    return entry.second != std::array{1, 1};
  }));
}

}  // namespace pelage::test
