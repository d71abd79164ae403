// Cells on a cloud of points: places move in the planes through the points around them.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "base/parallel.h"
#include "base/quantile.h"
#include "base/random.h"
#include "pelage/error.h"
#include "shape/cell_ground.h"
#include "shape/cell_voronoi.h"
#include "shape/cloud_points.h"
#include "shape/places.h"

namespace pelage {

namespace {

constexpr std::size_t chunk = 256;

class CloudGround final : public CellGround {
 public:
  explicit CloudGround(const TriangleMesh& mesh) : cloud_(cloud_points(mesh)) {
    double sum = 0;
    for (const double area : cloud_.area) sums_.push_back(sum += area);
    if (!(sum > 0) || !std::isfinite(sum))
      throw Error(Fault::input, "the points lie in no surface to lay cells on: they are on a line or in one place");
  }

  double area() const override { return sums_.back(); }
  Box box() const override { return box_of(cloud_.point); }
  std::size_t outliers() const override { return cloud_.outliers; }
  std::size_t points_that_count() const override { return cloud_.point.size(); }

  CellPlace scattered(std::size_t k, std::size_t n) const override {
    const std::size_t c = part_at(sums_, (static_cast<double>(k) + uniform(1, k)) / static_cast<double>(n));
    CellPlace place{cloud_.point[c], cloud_.normal[c], cloud_.number[c], {}};
    const double angle = 2 * std::numbers::pi * uniform(2, k);
    const double away = std::sqrt(uniform(3, k) * cloud_.area[c] / std::numbers::pi);
    const TangentFrame frame(cloud_.normal[c]);
    move(place, frame.out({away * std::cos(angle), away * std::sin(angle)}), static_cast<std::int32_t>(c));
    return place;
  }

  void move(CellPlace& place, const Point& step) const override {
    move(place, step, cloud_.kept[static_cast<std::size_t>(place.face)]);
  }

 private:
  void move(CellPlace& place, const Point& step, std::int32_t from) const;
  std::int32_t nearest(const Point& p, std::int32_t from) const;
  void hold(const CellPlace& place, std::int32_t near, Point& p) const;

  CloudPoints cloud_;
  std::vector<double> sums_;
};

/// From neighbour to nearer neighbour.
std::int32_t CloudGround::nearest(const Point& p, std::int32_t from) const {
  const auto square = [&](std::int32_t c) {
    const Point v = difference(p, cloud_.point[static_cast<std::size_t>(c)]);
    return dot(v, v);
  };
  double least = square(from);
  for (bool better = true; better;) {
    better = false;
    for (const std::int32_t c : cloud_.neighbours(static_cast<std::size_t>(from)))
      if (const double s = square(c); s < least) {
        least = s;
        from = c;
        better = true;
        break;
      }
  }
  return from;
}

/// Nobody leaves the cloud: at most about half the spacing of its points away from the nearest of them.
void CloudGround::hold(const CellPlace& place, std::int32_t near, Point& p) const {
  const auto c = static_cast<std::size_t>(near);
  const Point away = difference(p, cloud_.point[c]);
  const double along = dot(away, place.normal), furthest = 0.75 * std::sqrt(cloud_.area[c]);
  Point side;
  for (std::size_t k = 0; k < 3; ++k) side[k] = away[k] - along * place.normal[k];
  const double size = length(side);
  if (size <= furthest) return;
  for (std::size_t k = 0; k < 3; ++k) p[k] -= (1 - furthest / size) * side[k];
}

/// Onto the plane of the points around, with weights that fall to 0 at the last of the nearest one's neighbours.
void CloudGround::move(CellPlace& place, const Point& step, std::int32_t from) const {
  Point p = place.point;
  for (std::size_t k = 0; k < 3; ++k) p[k] += step[k];
  const std::int32_t near = nearest(p, from);
  const auto c = static_cast<std::size_t>(near);
  const double reach = cloud_.reach[c] + length(difference(p, cloud_.point[c]));
  Point middle{}, normal{};
  double sum = 0;
  const auto add = [&](std::int32_t other) {
    const auto o = static_cast<std::size_t>(other);
    const Point v = difference(cloud_.point[o], p);
    const double t = std::max(0.0, 1 - dot(v, v) / (reach * reach)), w = t * t;
    if (!(dot(cloud_.normal[o], cloud_.normal[c]) > 0)) return;  // the other side of a thin sheet
    sum += w;
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] += w * v[k];
      normal[k] += w * cloud_.normal[o][k];
    }
  };
  add(near);
  for (const std::int32_t other : cloud_.neighbours(c)) add(other);
  if (sum > 0 && length(normal) > 0) {
    place.normal = unit(normal);
    const double height = dot(middle, place.normal) / sum;
    for (std::size_t k = 0; k < 3; ++k) p[k] += height * place.normal[k];
  }
  hold(place, near, p);
  place.point = p;
  place.face = cloud_.number[c];
}

}  // namespace

std::unique_ptr<const CellGround> cloud_ground(std::shared_ptr<const TriangleMesh> mesh) {
  return std::make_unique<const CloudGround>(*mesh);
}

}  // namespace pelage
