#pragma once
// What can be said of texture coordinates by other means than those that made them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "shape/triangulate.h"

namespace pelage::testing {

/// In steps of uv, so that all that follows is exact.
using Step = std::array<std::int64_t, 2>;
using FlatTriangle = std::array<Step, 3>;

inline std::int64_t turn(const Step& a, const Step& b, const Step& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A mesh with "uv" per corner, its faces cut into triangles.
struct CutAtlas {
  TriangleMesh mesh;
  std::vector<std::int32_t> face;
  std::vector<FlatTriangle> flat;
};

inline CutAtlas cut_atlas(const PolygonMesh& mesh) {
  std::vector<Finding> findings;
  Triangulation cut = triangulate(mesh, findings);
  CutAtlas atlas{std::move(cut.mesh), std::move(cut.source_face), {}};
  const std::vector<double>& uv = atlas.mesh.find("uv")->values;
  for (std::size_t t = 0; t < atlas.face.size(); ++t) {
    FlatTriangle& flat = atlas.flat.emplace_back();
    for (std::size_t k = 0; k < 6; ++k) flat[k / 2][k % 2] = static_cast<std::int64_t>(std::ldexp(uv[6 * t + k], 24));
  }
  return atlas;
}

/// Of two triangles turned to the left, whether a side of the first has the other on its right, or on its line.
inline bool has_dividing_side(const FlatTriangle& a, const FlatTriangle& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::ranges::all_of(b, [&](const Step& p) { return turn(a[k], a[(k + 1) % 3], p) <= 0; })) return true;
  return false;
}

inline std::size_t turned_triangles(const CutAtlas& atlas) {
  return static_cast<std::size_t>(
      std::ranges::count_if(atlas.flat, [](const FlatTriangle& t) { return turn(t[0], t[1], t[2]) <= 0; }));
}

/// Pairs of triangles whose insides meet; found over squares of a 64th of the width.
inline std::size_t overlapping_pairs(const CutAtlas& atlas) {
  std::map<std::array<std::int64_t, 2>, std::vector<std::size_t>> squares;
  constexpr std::int64_t width = 1 << 18;
  for (std::size_t t = 0; t < atlas.flat.size(); ++t) {
    const auto& [a, b, c] = atlas.flat[t];
    const auto [left, right] = std::minmax({a[0], b[0], c[0]});
    const auto [low, high] = std::minmax({a[1], b[1], c[1]});
    for (std::int64_t x = left / width; x <= right / width; ++x)
      for (std::int64_t y = low / width; y <= high / width; ++y) squares[{x, y}].push_back(t);
  }
  std::size_t pairs = 0;
  for (const auto& [square, inside] : squares)
    for (std::size_t i = 0; i < inside.size(); ++i)
      for (std::size_t j = i + 1; j < inside.size(); ++j) {
        const FlatTriangle &s = atlas.flat[inside[i]], &t = atlas.flat[inside[j]];
        pairs += !has_dividing_side(s, t) && !has_dividing_side(t, s);
      }
  return pairs;
}

/// The L2 stretch as Sander et al. (2001) write it, by partial derivatives of the surface after u and v.
inline double l2_stretch(const CutAtlas& atlas) {
  double area = 0, flat = 0, squares = 0;
  for (std::size_t t = 0; t < atlas.flat.size(); ++t) {
    std::array<double, 3> s, v;
    for (std::size_t k = 0; k < 3; ++k) {
      s[k] = std::ldexp(static_cast<double>(atlas.flat[t][k][0]), -24);
      v[k] = std::ldexp(static_cast<double>(atlas.flat[t][k][1]), -24);
    }
    const double a = ((s[1] - s[0]) * (v[2] - v[0]) - (s[2] - s[0]) * (v[1] - v[0])) / 2;
    std::array<double, 3> qs, qt;
    for (std::size_t k = 0; k < 3; ++k) {
      const double q0 = atlas.mesh.points[atlas.mesh.triangles[t][0]][k];
      const double q1 = atlas.mesh.points[atlas.mesh.triangles[t][1]][k];
      const double q2 = atlas.mesh.points[atlas.mesh.triangles[t][2]][k];
      qs[k] = (q0 * (v[1] - v[2]) + q1 * (v[2] - v[0]) + q2 * (v[0] - v[1])) / (2 * a);
      qt[k] = (q0 * (s[2] - s[1]) + q1 * (s[0] - s[2]) + q2 * (s[1] - s[0])) / (2 * a);
    }
    const double ss = qs[0] * qs[0] + qs[1] * qs[1] + qs[2] * qs[2], tt = qt[0] * qt[0] + qt[1] * qt[1] + qt[2] * qt[2];
    const double st = qs[0] * qt[0] + qs[1] * qt[1] + qs[2] * qt[2];
    const double in_space = a * std::sqrt(ss * tt - st * st);
    area += in_space;
    flat += a;
    squares += in_space * (ss + tt) / 2;
  }
  return std::sqrt(squares / area) * std::sqrt(flat / area);
}

/// Triangles that share a side in uv are of one chart; numbered from 0.
struct UvCharts {
  std::vector<std::size_t> of_triangle;
  std::vector<long> euler;  ///< per chart: vertices - edges + faces of what hangs together in uv
  std::vector<std::pair<std::size_t, std::array<Step, 2>>> borders;  ///< chart and ends

  explicit UvCharts(const CutAtlas& atlas) : of_triangle(atlas.flat.size()) {
    std::map<std::pair<Step, Step>, std::vector<std::size_t>> sides;
    std::map<Step, std::size_t> corner;
    for (std::size_t t = 0; t < atlas.flat.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        sides[std::minmax({atlas.flat[t][k], atlas.flat[t][(k + 1) % 3]})].push_back(t);
    for (std::size_t t = 0; t < of_triangle.size(); ++t) of_triangle[t] = t;
    const auto root = [&](std::size_t t) {
      while (of_triangle[t] != t) t = of_triangle[t] = of_triangle[of_triangle[t]];
      return t;
    };
    for (const auto& [ends, at] : sides)
      of_triangle[std::max(root(at.front()), root(at.back()))] = std::min(root(at.front()), root(at.back()));
    std::map<std::size_t, std::size_t> number;
    for (std::size_t t = 0; t < of_triangle.size(); ++t) number.try_emplace(root(t), number.size());
    std::vector<std::size_t> chart(of_triangle.size());
    for (std::size_t t = 0; t < chart.size(); ++t) chart[t] = number.at(root(t));
    of_triangle = std::move(chart);
    euler.assign(number.size(), 0);
    for (std::size_t t = 0; t < of_triangle.size(); ++t) {
      ++euler[of_triangle[t]];
      for (const Step& p : atlas.flat[t]) corner.emplace(p, of_triangle[t]);
    }
    for (const auto& [p, c] : corner) ++euler[c];
    for (const auto& [ends, at] : sides) {
      --euler[of_triangle[at.front()]];
      if (at.size() == 1) borders.push_back({of_triangle[at.front()], {ends.first, ends.second}});
    }
  }
};

}  // namespace pelage::testing
