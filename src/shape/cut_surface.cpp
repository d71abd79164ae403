#include "shape/cut_surface.h"

#include <algorithm>
#include <cmath>

namespace pelage {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

Point on_way(const Point& a, const Point& b, double part) {
  return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])};
}

std::vector<CutPlace> roots(std::vector<CutPlace> edges, std::vector<double> at_from, std::vector<double> at_to,
                            const LevelFunction& level) {
  constexpr int most_steps = 24;
  constexpr double exact_enough = 1e-9;
  const std::size_t n = edges.size();
  std::vector<double> low(n, 0.0), high(n, 1.0);
  std::vector<int> kept(n, 0);
  for (int step = 0; step < most_steps; ++step) {
    double widest = 0;
    for (std::size_t e = 0; e < n; ++e) {
      const double before = edges[e].part, drop = at_from[e] - at_to[e];
      edges[e].part = drop != 0 ? std::clamp(low[e] + (high[e] - low[e]) * at_from[e] / drop, low[e], high[e]) : low[e];
      if (std::abs(kept[e]) > 2) edges[e].part = (low[e] + high[e]) / 2;
      widest = std::max(widest, std::abs(edges[e].part - before));
    }
    if (step > 0 && widest < exact_enough) break;
    const std::vector<double> values = level(edges);
    for (std::size_t e = 0; e < n; ++e) {
      const bool like_from = (values[e] > 0) == (at_from[e] > 0);
      (like_from ? low : high)[e] = edges[e].part;
      (like_from ? at_from : at_to)[e] = values[e];
      const bool again = like_from ? kept[e] > 0 : kept[e] < 0;
      if (again) (like_from ? at_to : at_from)[e] /= 2;
      kept[e] = (again ? kept[e] : 0) + (like_from ? 1 : -1);
    }
  }
  return edges;
}

std::vector<double> CutSurface::at_vertices(const std::vector<double>& values, std::size_t components) const {
  std::vector<double> result;
  result.reserve(vertex.size() * components);
  for (const auto& [from, to, part] : vertex)
    for (std::size_t k = 0; k < components; ++k) {
      const double a = values[components * at(from) + k], b = values[components * at(to) + k];
      result.push_back(a + part * (b - a));
    }
  return result;
}

std::vector<Point> CutSurface::at_vertices(const std::vector<Point>& old) const {
  std::vector<Point> result;
  result.reserve(vertex.size());
  for (const auto& [from, to, part] : vertex) result.push_back(on_way(old[at(from)], old[at(to)], part));
  return result;
}

Attribute CutSurface::of(const Attribute& a) const {
  Attribute result{a.name, a.components, a.domain, {}, a.type, a.labels};
  const auto n = static_cast<std::size_t>(a.components);
  const bool whole = !a.labels.empty() || is_integer(a.type);
  const auto take = [&](std::size_t from, std::size_t to, double part) {
    if (whole) part = part < 0.5 ? 0 : 1;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = a.values[n * from + k], y = a.values[n * to + k];
      result.values.push_back(part == 0 ? x : part == 1 ? y : x + part * (y - x));
    }
  };
  if (a.domain == Domain::vertex)
    for (const auto& [from, to, part] : vertex) take(at(from), at(to), part);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::size_t old = at(parent[t]);
    if (a.domain == Domain::face) take(old, old, 0);
    for (std::size_t k = 0; k < 3 && a.domain == Domain::corner; ++k)
      take(3 * old + at(corners[t][k].from), 3 * old + at(corners[t][k].to), corners[t][k].part);
  }
  return result;
}

}  // namespace pelage
