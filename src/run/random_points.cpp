#include "run/random_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "base/random.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Points in cubes with edges as long as the distance that is looked at.
class Cubes {
 public:
  explicit Cubes(double edge) : edge_(edge) {}
  void add(const Point& p) { cubes_[cube(p)].push_back(p); }
  /// Distance to the nearest point, or infinity if all are further away than an edge.
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
    for (std::size_t k = 0; k < 3; ++k) key[k] = static_cast<std::int64_t>(std::floor(p[k] / edge_));
    return key;
  }
  double edge_;
  std::map<Key, std::vector<Point>> cubes_;
};

}  // namespace

std::vector<double> distance_to_random_points(const std::vector<Point>& positions, double spacing, std::uint64_t seed) {
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair{hash(seed, i), i}; });
  Cubes chosen(spacing);
  for (const std::size_t i : order)
    if (chosen.distance(positions[i]) >= spacing) chosen.add(positions[i]);
  std::vector<double> distance;
  distance.reserve(positions.size());
  for (const Point& p : positions) distance.push_back(chosen.distance(p) / spacing);
  return distance;
}

}  // namespace pelage
