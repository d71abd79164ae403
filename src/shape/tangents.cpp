#include "shape/tangents.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>

#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Position, normal and uv.
using CornerValues = std::array<double, 8>;

CornerValues corner_values(const TriangleMesh& mesh, const Attribute& normal, const Attribute& uv, std::size_t corner) {
  const std::size_t vertex = at(mesh.triangles[corner / 3][corner % 3]);
  CornerValues values;
  std::ranges::copy(mesh.points[vertex], values.begin());
  std::copy_n(&normal.values[3 * (normal.domain == Domain::corner ? corner : vertex)], 3, values.begin() + 3);
  std::copy_n(&uv.values[2 * (uv.domain == Domain::corner ? corner : vertex)], 2, values.begin() + 6);
  return values;
}

Point point_of(const CornerValues& c) { return {c[0], c[1], c[2]}; }
Point normal_of(const CornerValues& c) { return {c[3], c[4], c[5]}; }

Point in_plane(const Point& x, const Point& normal) {
  const double along = dot(x, normal);
  return unit({x[0] - along * normal[0], x[1] - along * normal[1], x[2] - along * normal[2]});
}

/// Triangles whose corners are numbers of equal values, and how each lies in the image.
class TangentSpace {
 public:
  explicit TangentSpace(const TriangleMesh& mesh) {
    const Attribute *normal = mesh.find("normal"), *uv = mesh.find("uv");
    assert(normal && uv && normal->components == 3 && uv->components == 2);
    const std::size_t corners = 3 * mesh.triangles.size();
    std::vector<CornerValues> values;
    for (std::size_t c = 0; c < corners; ++c) values.push_back(corner_values(mesh, *normal, *uv, c));
    number_equal(values);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) add_face(f);
    find_neighbours();
    group_.assign(corners, none);
  }

  Attribute tangents() {
    // Those that have a side of their own come first: triangles without one go with the first group that reaches them.
    for (std::size_t c = 0; c < group_.size(); ++c)
      if (side_[c / 3] != 0 && group_[c] == none) spread(c);
    Attribute result{"tangent", 4, Domain::corner, std::vector<double>(4 * group_.size())};
    const std::vector<Point> sums = sums_of_groups();
    for (std::size_t c = 0; c < group_.size(); ++c) {
      const Point normal = normal_of(value(c));
      Point tangent = group_[c] == none ? Point{} : unit(sums[group_[c]]);
      if (tangent == Point{}) tangent = in_plane(std::abs(normal[0]) < 0.7 ? Point{1, 0, 0} : Point{0, 1, 0}, normal);
      std::ranges::copy(tangent, &result.values[4 * c]);
      result.values[4 * c + 3] = group_[c] == none || side_of_group_[group_[c]] > 0 ? 1 : -1;
    }
    return result;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  const CornerValues& value(std::size_t corner) const { return values_[number_[corner]]; }

  void number_equal(const std::vector<CornerValues>& all) {
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t c, std::size_t d) { return all[c] < all[d]; });
    number_.resize(all.size());
    for (const std::size_t c : order) {
      if (values_.empty() || values_.back() != all[c]) values_.push_back(all[c]);
      number_[c] = values_.size() - 1;
    }
  }

  void add_face(std::size_t f) {
    const CornerValues &a = value(3 * f), &b = value(3 * f + 1), &c = value(3 * f + 2);
    const Point ab = difference(point_of(b), point_of(a)), ac = difference(point_of(c), point_of(a));
    const double v_ab = b[7] - a[7], v_ac = c[7] - a[7];
    const double area = (b[6] - a[6]) * v_ac - (c[6] - a[6]) * v_ab;
    side_.push_back(area > 0 ? 1 : area < 0 ? -1 : 0);
    Point along{};
    for (std::size_t k = 0; k < 3; ++k) along[k] = side_.back() * (v_ac * ab[k] - v_ab * ac[k]);
    along_.push_back(unit(along));
    if (along_.back() == Point{}) side_.back() = 0;
  }

  /// Across the edge from corner c to the next one.
  void find_neighbours() {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges;
    across_.assign(number_.size(), none);
    for (std::size_t c = 0; c < number_.size(); ++c) {
      const std::size_t from = number_[c], to = number_[next(c)];
      const auto twin = edges.find({to, from});
      if (twin == edges.end()) {
        edges.emplace(std::pair{from, to}, c);
        continue;
      }
      across_[c] = twin->second;
      across_[twin->second] = c;
      edges.erase(twin);
    }
  }

  static std::size_t next(std::size_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
  static std::size_t previous(std::size_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

  /// A new group: the corner, and those on both sides of it at the same vertex that lie the same way round.
  void spread(std::size_t corner) {
    const std::size_t group = side_of_group_.size();
    side_of_group_.push_back(side_[corner / 3]);
    std::vector<std::size_t> found = {corner};
    while (!found.empty()) {
      const std::size_t c = found.back();
      found.pop_back();
      const int side = side_[c / 3];
      if (group_[c] != none || (side != 0 && side != side_of_group_[group])) continue;
      group_[c] = group;
      if (across_[c] != none) found.push_back(next(across_[c]));
      if (across_[previous(c)] != none) found.push_back(across_[previous(c)]);
    }
  }

  std::vector<Point> sums_of_groups() const {
    std::vector<Point> sums(side_of_group_.size(), Point{});
    for (std::size_t c = 0; c < group_.size(); ++c) {
      if (group_[c] == none || side_[c / 3] == 0) continue;
      const Point here = point_of(value(c)), normal = normal_of(value(c));
      const Point one = in_plane(difference(point_of(value(next(c))), here), normal),
                  other = in_plane(difference(point_of(value(previous(c))), here), normal);
      const double angle = std::acos(std::clamp(dot(one, other), -1.0, 1.0));
      const Point along = in_plane(along_[c / 3], normal);
      for (std::size_t k = 0; k < 3; ++k) sums[group_[c]][k] += angle * along[k];
    }
    return sums;
  }

  std::vector<CornerValues> values_;
  std::vector<std::size_t> number_;  ///< of the values of corners
  std::vector<int> side_;            ///< of faces: 1, or -1 where they are mirrored; 0 without area in the image
  std::vector<Point> along_;         ///< of faces: the direction in which u grows
  std::vector<std::size_t> across_;  ///< of corners: that at which the same edge begins in the neighbour
  std::vector<std::size_t> group_;   ///< of corners
  std::vector<int> side_of_group_;
};

}  // namespace

Attribute corner_tangents(const TriangleMesh& mesh) { return TangentSpace(mesh).tangents(); }

}  // namespace pelage
