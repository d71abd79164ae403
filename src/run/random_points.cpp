#include "run/random_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "base/box.h"
#include "base/checked.h"
#include "base/random.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Points in cubes with edges at least as long as the distance that is looked at, numbered from the lowest corner of
/// the box around `positions`. Along its longest side lie no more than a million cubes: smaller ones hold no more than
/// a point each anyway.
class Cubes {
 public:
  Cubes(const std::vector<Point>& positions, double distance) : edge_(distance) {
    if (!positions.empty()) low_ = positions[0];
    for (const Point& p : positions)
      for (std::size_t k = 0; k < 3; ++k) low_[k] = std::min(low_[k], p[k]);
    for (const Point& p : positions)
      for (std::size_t k = 0; k < 3; ++k) edge_ = std::max(edge_, (p[k] - low_[k]) / 1e6);
  }
  void add(const Point& p) { cubes_[cube(p)].push_back(p); }
  /// Distance to the nearest point, or infinity if all are further away than the distance that is looked at.
  double distance(const Point& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    const Key middle = cube(p);
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const Key key{middle[0] + neighbour % 3 - 1, middle[1] + neighbour / 3 % 3 - 1, middle[2] + neighbour / 9 - 1};
      const auto found = cubes_.find(key);
      if (found == cubes_.end()) continue;
      for (const Point& q : found->second) nearest = std::min(nearest, length(difference(q, p)));
    }
    return nearest;
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  Key cube(const Point& p) const {
    Key key;
    for (std::size_t k = 0; k < 3; ++k) key[k] = saturated<std::int64_t>(std::floor((p[k] - low_[k]) / edge_));
    return key;
  }
  double edge_;
  Point low_{};
  std::map<Key, std::vector<Point>> cubes_;
};

}  // namespace

namespace {

/// A point and where space repeats it next to the box.
template <class Use>
void for_images(const Point& p, const Point& period, Use&& use) {
  for (int image = 0; image < 27; ++image) {
    const std::array<int, 3> step = {image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
    Point moved = p;
    bool repeats = true;
    for (std::size_t k = 0; k < 3; ++k) {
      repeats &= step[k] == 0 || period[k] > 0;
      moved[k] += step[k] * period[k];
    }
    if (repeats) use(moved);
  }
}

}  // namespace

std::vector<double> distance_to_random_points(const std::vector<Point>& positions, double spacing, std::uint64_t seed,
                                              const Point& period) {
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Point middle = box_of(positions).middle();
  std::vector<std::uint64_t> rank;
  rank.reserve(positions.size());
  for (const Point& p : positions) rank.push_back(place_seed(difference(p, middle), spacing, seed));
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair{rank[i], i}; });
  Cubes chosen(positions, spacing);
  for (const std::size_t i : order)
    if (chosen.distance(positions[i]) >= spacing)
      for_images(positions[i], period, [&](const Point& p) { chosen.add(p); });
  std::vector<double> distance;
  distance.reserve(positions.size());
  for (const Point& p : positions) distance.push_back(chosen.distance(p) / spacing);
  return distance;
}

std::vector<double> distance_to_jittered_diamonds(const std::vector<Point>& positions, double spacing, double jitter,
                                                  std::uint64_t seed, const Point& period) {
  const Box box = box_of(positions);
  std::array<double, 2> step;
  std::array<std::int64_t, 2> count;
  for (std::size_t k = 0; k < 2; ++k) {
    const double length = period[k] > 0 ? period[k] : box.high[k] - box.low[k];
    count[k] = std::llround(std::clamp(length / (std::numbers::sqrt2 * spacing), 1.0, 1e6));
    step[k] = length / static_cast<double>(count[k]);
  }
  if (2 * count[0] * count[1] > std::ssize(positions)) return std::vector<double>(positions.size(), 0);  // no gaps
  constexpr double furthest = 2;  // of a place from the nearest point [spacings]
  Cubes points(positions, furthest * spacing);
  for (std::int64_t j = 0; j < 2 * count[1]; ++j)
    for (std::int64_t i = 0; i < count[0]; ++i) {
      // Two points in a diamond of the coarser, upright grid: rows are shifted by half a step in turn.
      const std::uint64_t key = hash(hash(seed, static_cast<std::uint64_t>(j)), static_cast<std::uint64_t>(i));
      const auto moved = [&](std::uint64_t axis) { return jitter * spacing * (uniform(key, axis) - 0.5); };
      const double across = static_cast<double>(i) + (j % 2 == 0 ? 0.25 : 0.75);
      const double up = (static_cast<double>(j) + 0.5) / 2;
      for_images({box.low[0] + across * step[0] + moved(0), box.low[1] + up * step[1] + moved(1), box.low[2]}, period,
                 [&](const Point& p) { points.add(p); });
    }
  std::vector<double> distance;
  distance.reserve(positions.size());
  for (const Point& p : positions) distance.push_back(points.distance(p) / spacing);
  return distance;
}

}  // namespace pelage
