// Cells on polygons that need not fit together (Turk 1991, section 4): points are pushed over edges, and over cracks
// and T-junctions onto the polygon that goes on nearest to where they are pushed.

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/random.h"
#include "pelage/error.h"
#include "shape/cell_ground.h"
#include "shape/cell_neighbours.h"
#include "shape/closest_point.h"
#include "shape/soup_edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

constexpr int most_crossings = 64;  ///< of one step: long and thin triangles in a row

Point moved(const Point& p, double t, const Point& step) {
  return {p[0] + t * step[0], p[1] + t * step[1], p[2] + t * step[2]};
}

class PolygonGround final : public CellGround {
 public:
  explicit PolygonGround(std::shared_ptr<const TriangleMesh> mesh)
      : mesh_(std::move(mesh)), twin_(soup_twins(*mesh_)), covered_(CoveredParts::of(mesh_)) {
    double sum = 0;
    for (const Triangle& t : mesh_->triangles) {
      const Point n = cross(difference(at(t[1]), at(t[0])), difference(at(t[2]), at(t[0])));
      normal_.push_back(unit(n));
      sums_.push_back(sum += length(n) / 2);
    }
    if (covered_) sum = sum_up_pieces();
    if (!(sum > 0) || !std::isfinite(sum)) throw Error(Fault::input, "the shape has no area to lay cells on");
  }

  double area() const override { return sums_.back(); }
  Box box() const override { return box_of(mesh_->points); }
  std::shared_ptr<const CoveredParts> covered() const override { return covered_; }

  CellPlace scattered(std::size_t k, std::size_t n) const override {
    const double share = (static_cast<double>(k) + uniform(1, k)) / static_cast<double>(n);
    CellPlace place;
    const std::size_t part = part_at(sums_, share);
    const double root = std::sqrt(uniform(2, k)), side = uniform(3, k);
    const std::array<double, 2> in = {root * (1 - side), root * side};
    if (covered_) return scattered_on(covered_->seen()[part], in);
    place.face = static_cast<std::int32_t>(part);
    put(place, in);
    return place;
  }

  void move(CellPlace& place, const Point& step) const override;

 private:
  const Point& at(std::int32_t v) const { return mesh_->points[static_cast<std::size_t>(v)]; }
  std::array<Point, 3> corners(std::int32_t face) const {
    const Triangle& t = mesh_->triangles[static_cast<std::size_t>(face)];
    return {at(t[0]), at(t[1]), at(t[2])};
  }
  const Point& normal(std::int32_t face) const { return normal_[static_cast<std::size_t>(face)]; }
  /// Not so where it has no area, or is the other side of a sheet.
  bool goes_on(std::int32_t face, const Point& from) const {
    return dot(normal(face), normal(face)) > 0 && dot(normal(face), from) > opposing_normals;
  }
  double sum_up_pieces();
  CellPlace scattered_on(const CoveredParts::Piece& piece, const std::array<double, 2>& in) const;
  bool is_covered(const CellPlace& place) const { return covered_ && covered_->covers(place.face, place.point); }
  void walk(CellPlace& place, const Point& step) const;
  void turn_aside(CellPlace& place, const Point& step) const;
  std::int32_t nearest_wall(const CellPlace& place, double reach) const;
  void put(CellPlace& place, const std::array<double, 2>& in) const;
  void put_nearest(CellPlace& place, const Point& p) const;
  void cross_gap(CellPlace& place, const Point& rest) const;
  const DistanceTree& tree() const {
    std::call_once(tree_made_, [&] { tree_ = std::make_unique<const DistanceTree>(*mesh_); });
    return *tree_;
  }

  std::shared_ptr<const TriangleMesh> mesh_;
  std::vector<std::int32_t> twin_;  ///< per half-edge, or below 0
  std::vector<Point> normal_;
  std::shared_ptr<const CoveredParts> covered_;
  std::vector<double> sums_;  ///< of the areas up to each triangle, or to each piece that is not covered
  mutable std::once_flag tree_made_;
  mutable std::unique_ptr<const DistanceTree> tree_;
};

void PolygonGround::put(CellPlace& place, const std::array<double, 2>& in) const {
  const auto [a, b, c] = corners(place.face);
  const auto [v, w] = place.place = in;
  for (std::size_t k = 0; k < 3; ++k) place.point[k] = (1 - v - w) * a[k] + v * b[k] + w * c[k];
  place.normal = normal(place.face);
}

void PolygonGround::put_nearest(CellPlace& place, const Point& p) const {
  const auto [a, b, c] = corners(place.face);
  put(place, closest_place(p, a, b, c));
}

/// Coordinates of the steps from a: shares of its sides.
std::array<double, 2> shares(const Point& step, const std::array<Point, 3>& corner) {
  const Point e = difference(corner[1], corner[0]), f = difference(corner[2], corner[0]);
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), se = dot(step, e), sf = dot(step, f);
  const double determinant = ee * ff - ef * ef;
  if (!(determinant > 0)) return {};
  return {(ff * se - ef * sf) / determinant, (ee * sf - ef * se) / determinant};
}

/// Where a step leaves its triangle: half-edge 0, 1 or 2, and the share of the step until there; -1: it does not.
std::pair<int, double> way_out(const std::array<double, 2>& place, const std::array<double, 2>& step) {
  // What vanishes on the half-edges a b, b c and c a.
  const std::array<double, 3> from = {place[1], 1 - place[0] - place[1], place[0]};
  const std::array<double, 3> change = {step[1], -step[0] - step[1], step[0]};
  std::pair<int, double> out = {-1, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    if (from[k] + change[k] >= 0 || change[k] >= 0) continue;
    const double t = std::max(0.0, from[k]) / -change[k];
    if (t < out.second) out = {static_cast<int>(k), t};
  }
  return out;
}

void PolygonGround::walk(CellPlace& place, const Point& step) const {
  Point rest = step;
  for (int crossing = 0; crossing < most_crossings; ++crossing) {
    const std::array<double, 2> change = shares(rest, corners(place.face));
    const auto [edge, t] = way_out(place.place, change);
    put(place, {place.place[0] + t * change[0], place.place[1] + t * change[1]});
    if (edge < 0) return;
    for (double& x : rest) x *= 1 - t;
    const std::int32_t twin = twin_[static_cast<std::size_t>(3 * place.face + edge)];
    const std::int32_t next = twin / 3;
    if (twin < 0 || !goes_on(next, place.normal)) return cross_gap(place, rest);
    rest = turned_into(rest, place.normal, normal(next));
    place.face = next;
    put_nearest(place, place.point);
  }
}

/// Of all triangles around, this one included, to that which takes the place nearest to where it is pushed.
void PolygonGround::cross_gap(CellPlace& place, const Point& rest) const {
  const double reach = length(rest);
  const CellPlace from = place;
  double best = std::numeric_limits<double>::infinity();
  for (const std::int32_t face : tree().within(from.point, reach * (1 + 1e-9))) {
    if (!goes_on(face, from.normal)) continue;
    CellPlace on = from;
    on.face = face;
    put_nearest(on, from.point);
    const double gap = length(difference(on.point, from.point));
    const Point target = moved(on.point, 1, turned_into(rest, from.normal, normal(face)));
    put_nearest(on, target);
    const double missed = gap + length(difference(on.point, target));
    if (missed >= best) continue;
    best = missed;
    place = on;
  }
}

double PolygonGround::sum_up_pieces() {
  double sum = 0;
  const std::vector<double> whole = std::move(sums_);
  sums_.clear();
  for (const CoveredParts::Piece& piece : covered_->seen()) {
    const auto f = static_cast<std::size_t>(piece.face);
    const auto& [a, b, c] = piece.corner;
    const double share = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    sums_.push_back(sum += share * (whole[f] - (f > 0 ? whole[f - 1] : 0)));
  }
  return sum;
}

/// Pieces at the line where parts meet are seen at least in their middle.
CellPlace PolygonGround::scattered_on(const CoveredParts::Piece& piece, const std::array<double, 2>& in) const {
  const auto &a = piece.corner[0], &b = piece.corner[1], &c = piece.corner[2];
  const auto put_at = [&](double v, double w) {
    CellPlace place;
    place.face = piece.face;
    put(place, {(1 - v - w) * a[0] + v * b[0] + w * c[0], (1 - v - w) * a[1] + v * b[1] + w * c[1]});
    return place;
  };
  const CellPlace place = put_at(in[0], in[1]);
  return is_covered(place) ? put_at(1.0 / 3, 1.0 / 3) : place;
}

void PolygonGround::move(CellPlace& place, const Point& step) const {
  const CellPlace from = place;
  walk(place, step);
  if (!is_covered(place)) return;
  place = from;
  turn_aside(place, step);
}

/// Up to where another part covers the ground, and on along that part.
void PolygonGround::turn_aside(CellPlace& place, const Point& step) const {
  constexpr int halvings = 12;
  const CellPlace from = place;
  double share = 0;
  for (int k = 1; k <= halvings; ++k) {
    const double further = share + std::ldexp(1, -k);
    CellPlace there = from;
    walk(there, moved({}, further, step));
    if (is_covered(there)) continue;
    share = further;
    place = there;
  }
  const std::int32_t wall = nearest_wall(place, length(step));
  if (wall < 0) return;
  const Point rest = turned_into(moved({}, 1 - share, step), from.normal, place.normal);
  CellPlace on = place;
  on.face = wall;
  put_nearest(on, place.point);
  walk(on, turned_into(rest, place.normal, normal(wall)));
  if (!is_covered(on)) place = on;
}

/// Of other parts; -1: none within reach.
std::int32_t PolygonGround::nearest_wall(const CellPlace& place, double reach) const {
  std::int32_t best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t face : tree().within(place.point, reach)) {
    if (covered_->same_part(face, place.face) || !goes_on(face, place.normal)) continue;
    const auto [a, b, c] = corners(face);
    const double square = square_distance(place.point, a, b, c);
    if (square >= least) continue;
    least = square;
    best = face;
  }
  return best;
}

}  // namespace

std::unique_ptr<const CellGround> polygon_ground(std::shared_ptr<const TriangleMesh> mesh) {
  return std::make_unique<const PolygonGround>(std::move(mesh));
}

std::size_t part_at(const std::vector<double>& sums, double share) {
  const auto it = std::ranges::upper_bound(sums, share * sums.back());
  return static_cast<std::size_t>(std::min<std::ptrdiff_t>(it - sums.begin(), std::ssize(sums) - 1));
}

}  // namespace pelage
