#pragma once
// Neighbours of cells, unfolded into the tangent plane (Turk 1991, section 4: points on a neighbouring polygon are
// turned about the edge between them).

#include <algorithm>
#include <span>
#include <vector>

#include "shape/point_index.h"
#include "shape/vectors.h"

namespace pelage {

/// Normals whose product is less belong to two sides of a sheet.
inline constexpr double opposing_normals = -0.8;

/// The vector v, tangential to a plane with the normal n, turned about the line where that plane meets another one with
/// the normal m.
inline Point turned_into(const Point& v, const Point& n, const Point& m) {
  const double share = dot(v, m) / (1 + dot(n, m));
  return {v[0] - share * (n[0] + m[0]), v[1] - share * (n[1] + m[1]), v[2] - share * (n[2] + m[2])};
}

/// The way between two places on a surface when their tangent planes, with the normals n and m, are unfolded about the
/// line where they meet: v is the straight one. Its square is the same from either end, to the bit.
struct Unfolded {
  Point way;  ///< in the plane of n
  double square;
};
inline Unfolded unfolded(const Point& v, const Point& n, const Point& m) {
  const double c = 1 + dot(n, m), vn = dot(v, n), vm = dot(v, m);
  const double share = vn / c;
  return {{v[0] - share * (n[0] + m[0]), v[1] - share * (n[1] + m[1]), v[2] - share * (n[2] + m[2])},
          dot(v, v) - 2 * (vn * vm) / c};
}

/// Whether two places belong to one sheet: not so where normals oppose, nor where one lies above the other. Where
/// planes are really folded between them, the way along them is never shorter than the straight one.
inline bool on_one_sheet(const Point& v, double unfolded_square, const Point& n, const Point& m) {
  const double c = dot(n, m);
  // Noise may turn the normals: of nearly flat places only what lies steeply above is told apart.
  const double least = std::min(0.95, 1.5 - c);
  return c > opposing_normals && unfolded_square >= least * dot(v, v);
}

struct CellNeighbour {
  std::int32_t cell;
  Point way;      ///< to it, in the tangent plane
  double square;  ///< of the length of the way
};

class CellNeighbours {
 public:
  /// `points` and `normals` must outlive it; `radius`: of most queries.
  CellNeighbours(std::span<const Point> points, std::span<const Point> normals, double radius)
      : points_(points), normals_(normals), index_(points, radius) {}

  /// Calls visit(CellNeighbour) for all on the sheet of a place whose way is at most `radius`.
  template <class Visit>
  void for_each(const Point& from, const Point& normal, double radius, Visit&& visit) const {
    index_.for_each_within(from, radius, [&](std::int32_t j, double) {
      const Point v = difference(points_[static_cast<std::size_t>(j)], from);
      const Point& m = normals_[static_cast<std::size_t>(j)];
      if (!(dot(normal, m) > opposing_normals)) return;
      const Unfolded u = unfolded(v, normal, m);
      if (u.square <= radius * radius && on_one_sheet(v, u.square, normal, m)) visit(CellNeighbour{j, u.way, u.square});
    });
  }
  /// The same but for the cell `except`; replaces `found`.
  void find(const Point& from, const Point& normal, double radius, std::int32_t except,
            std::vector<CellNeighbour>& found) const {
    found.clear();
    for_each(from, normal, radius, [&](const CellNeighbour& n) {
      if (n.cell != except) found.push_back(n);
    });
  }
  void find(std::size_t cell, double radius, std::vector<CellNeighbour>& found) const {
    find(points_[cell], normals_[cell], radius, static_cast<std::int32_t>(cell), found);
  }

 private:
  std::span<const Point> points_, normals_;
  PointIndex index_;
};

}  // namespace pelage
