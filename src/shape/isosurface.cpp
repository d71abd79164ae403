#include "shape/isosurface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/parallel.h"

namespace pelage {

namespace {

// Corners of a cube are numbered by the bits of their offset (x = 1, y = 2, z = 4). The six tetrahedra are the
// monotone paths from corner 0 to corner 7; the last two columns of odd paths are swapped to orient all alike.
constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 1, 7, 5}, {0, 2, 7, 3}, {0, 4, 7, 6}};

class MarchingTetrahedra {
 public:
  MarchingTetrahedra(const Field& field, const Point& lower, const Point& upper, double spacing)
      : lower_(lower), spacing_(spacing) {
    for (int d = 0; d < 3; ++d) size_[d] = 1 + static_cast<std::int64_t>(std::ceil((upper[d] - lower[d]) / spacing));
    values_.resize(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]));
    parallel_for(values_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) values_[i] = field(place(static_cast<std::int64_t>(i))).value;
    });
  }

  TriangleMesh march() {
    for (std::int64_t z = 0; z + 1 < size_[2]; ++z)
      for (std::int64_t y = 0; y + 1 < size_[1]; ++y)
        for (std::int64_t x = 0; x + 1 < size_[0]; ++x)
          for (const auto& tetrahedron : tetrahedra) cut(x + size_[0] * (y + size_[1] * z), tetrahedron);
    return std::move(mesh_);
  }

 private:
  Point place(std::int64_t node) const {
    const std::int64_t index[3] = {node % size_[0], node / size_[0] % size_[1], node / (size_[0] * size_[1])};
    Point p;
    for (int d = 0; d < 3; ++d) p[d] = lower_[d] + spacing_ * static_cast<double>(index[d]);
    return p;
  }

  std::int64_t node(std::int64_t base, int corner) const {
    return base + (corner & 1) + size_[0] * ((corner >> 1 & 1) + size_[1] * (corner >> 2));
  }

  /// The mesh vertex between two corners of the cube at `base`, made at the first call.
  std::int32_t crossing(std::int64_t base, int from, int to) {
    if (from > to) std::swap(from, to);
    const std::int64_t a = node(base, from);
    const auto [entry, is_new] = crossings_.try_emplace(8 * a + (from ^ to), mesh_.points.size());
    if (is_new) {
      const std::int64_t b = node(base, to);
      const double inside_part = values_[a] / (values_[a] - values_[b]);
      const double t = std::clamp(inside_part, 0.1, 0.9);  // away from the nodes: no triangle degenerates
      const Point p = place(a), q = place(b);
      mesh_.points.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
    }
    return static_cast<std::int32_t>(entry->second);
  }

  void add(bool flipped, std::int32_t a, std::int32_t b, std::int32_t c) {
    mesh_.triangles.push_back(flipped ? Triangle{a, c, b} : Triangle{a, b, c});
  }

  void cut(std::int64_t base, const int (&tetrahedron)[4]) {
    int v[4];
    bool inside[4];
    for (int k = 0; k < 4; ++k) inside[k] = values_[node(base, v[k] = tetrahedron[k])] < 0;
    bool odd = false;  // brings the inner corners to the front, by exchanges of neighbours
    for (int pass = 0; pass < 3; ++pass)
      for (int k = 0; k < 3; ++k)
        if (!inside[k] && inside[k + 1]) {
          std::swap(v[k], v[k + 1]);
          std::swap(inside[k], inside[k + 1]);
          odd = !odd;
        }
    auto at = [&](int i, int j) { return crossing(base, v[i], v[j]); };
    switch (std::count(inside, inside + 4, true)) {
      case 1:
        add(odd, at(0, 1), at(0, 2), at(0, 3));
        break;
      case 2:
        add(odd, at(0, 2), at(0, 3), at(1, 3));
        add(odd, at(0, 2), at(1, 3), at(1, 2));
        break;
      case 3:
        add(odd, at(0, 3), at(1, 3), at(2, 3));
        break;
      default:
        break;
    }
  }

  Point lower_;
  double spacing_;
  std::int64_t size_[3] = {};
  std::vector<double> values_;
  std::unordered_map<std::int64_t, std::size_t> crossings_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh isosurface(const Field& field, const Point& lower, const Point& upper, double spacing) {
  return MarchingTetrahedra(field, lower, upper, spacing).march();
}

Point project_to_surface(const Field& field, const Point& start, double reach) {
  Point p = start;
  for (int iteration = 0; iteration < 20; ++iteration) {  // converges quadratically: four or five are the rule
    const auto [value, g] = field(p);
    const double norm = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    if (norm == 0 || std::abs(value) <= 1e-14 * norm) break;
    const double step = std::clamp(value / norm, -reach, reach);  // a nearly flat field must not throw the point away
    for (int d = 0; d < 3; ++d) p[d] -= step / norm * g[d];
  }
  return p;
}

}  // namespace pelage
