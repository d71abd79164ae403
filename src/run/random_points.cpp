#include "run/random_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
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

}  // namespace pelage
