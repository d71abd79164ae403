#include "shape/cell_relaxation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/checked.h"
#include "base/parallel.h"
#include "base/random.h"
#include "shape/cell_neighbours.h"

namespace pelage {

namespace {

constexpr int most_sweeps = 40;
/// All move at once: about 13 neighbours push a point back by up to 13 times the share of the radius that it is off,
/// less what they push it aside; from a sixth on they would overshoot.
constexpr double step_share = 0.1;
constexpr double even_step = 0.004;  ///< mean step [radius] from which on nothing more is to be gained
constexpr std::size_t chunk = 256;

/// Points in one place part in directions of their own.
Point any_direction(const Point& normal, std::size_t cell) {
  const double angle = 2 * std::numbers::pi * uniform(4, cell);
  const Point axis = std::abs(normal[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point e = unit(cross(normal, axis)), f = cross(normal, e);
  Point d;
  for (std::size_t k = 0; k < 3; ++k) d[k] = std::cos(angle) * e[k] + std::sin(angle) * f[k];
  return d;
}

Point repulsion(const std::vector<CellNeighbour>& neighbours, const Point& normal, std::size_t cell, double radius) {
  Point sum{};
  for (const CellNeighbour& n : neighbours) {
    const double distance = std::sqrt(n.square);
    if (distance < 1e-9 * radius) {
      const Point d = any_direction(normal, cell);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += d[k];
      continue;
    }
    const double force = (1 - distance / radius) / distance;
    for (std::size_t k = 0; k < 3; ++k) sum[k] -= force * n.way[k];
  }
  const double size = length(sum);
  const double share = step_share * radius * (size > 5 ? 5 / size : 1);  // a crowd is dissolved step by step
  for (double& x : sum) x *= share;
  return sum;
}

/// The mean step [radius].
double sweep(const CellGround& ground, std::vector<CellPlace>& places, double radius) {
  std::vector<Point> points, normals;
  for (const CellPlace& p : places) {
    points.push_back(p.point);
    normals.push_back(p.normal);
  }
  const CellNeighbours all(points, normals, radius);
  const double steps = ordered_sum(
      places.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        std::vector<CellNeighbour> found;
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) {
          all.find(i, radius, found);
          const Point step = repulsion(found, normals[i], i, radius);
          sum += length(step);
          ground.move(places[i], step);
        }
        return sum;
      },
      chunk);
  return steps / static_cast<double>(places.size()) / radius;
}

/// Places near each other get numbers near each other: by the bits of their boxes in turn (Morton 1966), so that what
/// a cell asks of its neighbours lies near in memory.
void sort_by_place(std::vector<CellPlace>& places, const Point& low, double side) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::uint64_t code = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto box = saturated<std::uint32_t>((places[i].point[k] - low[k]) / side);
      for (unsigned bit = 0; bit < 21; ++bit) code |= std::uint64_t{box >> bit & 1U} << (3 * bit + k);
    }
    order.emplace_back(code, i);
  }
  std::ranges::sort(order);
  std::vector<CellPlace> sorted;
  sorted.reserve(places.size());
  for (const auto& [code, i] : order) sorted.push_back(places[i]);
  places = std::move(sorted);
}

}  // namespace

std::vector<CellPlace> relaxed_places(const CellGround& ground, std::size_t n, double radius) {
  std::vector<CellPlace> places(n);
  parallel_for(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) places[k] = ground.scattered(k, n);
  });
  sort_by_place(places, ground.box().low, radius);
  for (int k = 0; k < most_sweeps; ++k)
    if (sweep(ground, places, radius) < even_step) break;
  return places;
}

}  // namespace pelage
