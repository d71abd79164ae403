#include "unwrap/outline.h"

#include <algorithm>
#include <cmath>

namespace pelage {

namespace {

double cross(const Flat& o, const Flat& a, const Flat& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

}  // namespace

void FlatBox::add(const Flat& p) {
  for (std::size_t k = 0; k < 2; ++k) {
    low[k] = std::min(low[k], p[k]);
    high[k] = std::max(high[k], p[k]);
  }
}

FlatBox flat_box(const std::vector<Flat>& places) {
  FlatBox box;
  for (const Flat& p : places) box.add(p);
  return box;
}

double area_of(const std::vector<Flat>& polygon) {
  double sum = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) sum += cross(polygon[0], polygon[k - 1], polygon[k]) / 2;
  return sum;
}

std::vector<Flat> turned(const std::vector<Flat>& places, double c, double s) {
  std::vector<Flat> result;
  result.reserve(places.size());
  for (const Flat& p : places) result.push_back({c * p[0] - s * p[1], s * p[0] + c * p[1]});
  const Flat low = flat_box(result).low;
  for (Flat& p : result) p = {p[0] - low[0], p[1] - low[1]};
  return result;
}

std::vector<Flat> convex_hull(std::vector<Flat> places) {
  std::ranges::sort(places);
  std::vector<Flat> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = hull.size();
    for (const Flat& p : places) {
      while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(places);
  }
  return hull;
}

std::vector<Flat> in_smallest_box(const std::vector<Flat>& places) {
  const std::vector<Flat> hull = convex_hull(places);
  double least = std::numeric_limits<double>::infinity();
  Flat turn{1, 0};
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Flat &a = hull[k], &b = hull[(k + 1) % hull.size()];
    const double l = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (!(l > 0)) continue;
    const double c = (b[0] - a[0]) / l, s = (a[1] - b[1]) / l;
    const FlatBox box = flat_box(turned(hull, c, s));
    const double size = box.width() * box.height();
    if (size >= least * (1 - 1e-9)) continue;
    least = size;
    turn = box.width() >= box.height() ? Flat{c, s} : Flat{-s, c};
  }
  return turned(places, turn[0], turn[1]);
}

}  // namespace pelage
