#include "gridgen/transfinite.h"

#include <algorithm>
#include <cmath>

#include "shape/vectors.h"

namespace pelage {

namespace {

void add(double a, const Point& p, Point& sum) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += a * p[k];
}

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<Point> transfinite(const Sheet& sheet, const Border& border) {
  const auto& [south, east, north, west] = border.side;
  const auto [n, m] = sheet.count;
  std::vector<Point> nodes(sheet.nodes());
  for (std::int32_t j = 0; j < m; ++j)
    for (std::int32_t i = 0; i < n; ++i) {
      const double u = static_cast<double>(i) / (n - 1), v = static_cast<double>(j) / (m - 1);
      Point& x = nodes[sheet.node(i, j)];
      add(1 - v, south[index(i)], x);
      add(v, north[index(i)], x);
      if (sheet.ring) continue;
      add(1 - u, west[index(j)], x);
      add(u, east[index(j)], x);
      add(-(1 - u) * (1 - v), south.front(), x);
      add(-u * (1 - v), south.back(), x);
      add(-(1 - u) * v, north.front(), x);
      add(-u * v, north.back(), x);
    }
  if (sheet.ring) return nodes;
  for (std::int32_t i = 0; i < n; ++i) {  // without rounding
    nodes[sheet.node(i, 0)] = south[index(i)];
    nodes[sheet.node(i, m - 1)] = north[index(i)];
  }
  for (std::int32_t j = 0; j < m; ++j) {
    nodes[sheet.node(0, j)] = west[index(j)];
    nodes[sheet.node(n - 1, j)] = east[index(j)];
  }
  return nodes;
}

namespace {

/// Weights of up to four neighbouring nodes of an axis at a place between them (Lagrange).
struct Weights {
  std::array<std::int32_t, 4> node{};
  std::array<double, 4> weight{};
};

Weights weights_at(double place, std::int32_t count, bool periodic) {
  const std::int32_t used = std::min(4, count);
  auto first = static_cast<std::int32_t>(std::floor(place)) - (used == 4 ? 1 : 0);
  if (!periodic) first = std::clamp(first, 0, count - used);
  Weights w;
  for (std::int32_t a = 0; a < used; ++a) {
    w.node[index(a)] = (first + a + count) % count;
    double product = 1;
    for (std::int32_t b = 0; b < used; ++b)
      if (b != a) product *= (place - first - b) / (a - b);
    w.weight[index(a)] = product;
  }
  return w;
}

std::vector<Weights> axis_weights(std::int32_t coarse, std::int32_t fine, bool periodic) {
  std::vector<Weights> list;
  const double scale = periodic ? static_cast<double>(coarse) / fine : (coarse - 1.0) / (fine - 1.0);
  for (std::int32_t i = 0; i < fine; ++i) list.push_back(weights_at(i * scale, coarse, periodic));
  return list;
}

std::vector<Point> interpolated(const Sheet& coarse, const std::vector<Point>& nodes, const Sheet& sheet) {
  const auto along = axis_weights(coarse.count[0], sheet.count[0], sheet.ring);
  const auto across = axis_weights(coarse.count[1], sheet.count[1], false);
  std::vector<Point> result(sheet.nodes());
  for (std::int32_t j = 0; j < sheet.count[1]; ++j)
    for (std::int32_t i = 0; i < sheet.count[0]; ++i)
      for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t a = 0; a < 4; ++a)
          add(along[index(i)].weight[a] * across[index(j)].weight[b],
              nodes[coarse.node(along[index(i)].node[a], across[index(j)].node[b])], result[sheet.node(i, j)]);
  return result;
}

}  // namespace

std::vector<Point> refined(const Sheet& coarse, const std::vector<Point>& coarse_nodes, const Sheet& sheet,
                           const Border& border) {
  std::vector<Point> nodes = interpolated(coarse, coarse_nodes, sheet);
  Border off;
  for (std::int32_t i = 0; i < sheet.count[0]; ++i) {
    off.side[0].push_back(difference(border.side[0][index(i)], nodes[sheet.node(i, 0)]));
    off.side[2].push_back(difference(border.side[2][index(i)], nodes[sheet.node(i, sheet.count[1] - 1)]));
  }
  for (std::int32_t j = 0; j < sheet.count[1] && !sheet.ring; ++j) {
    off.side[3].push_back(difference(border.side[3][index(j)], nodes[sheet.node(0, j)]));
    off.side[1].push_back(difference(border.side[1][index(j)], nodes[sheet.node(sheet.count[0] - 1, j)]));
  }
  const std::vector<Point> correction = transfinite(sheet, off), exact = transfinite(sheet, border);
  for (std::size_t v = 0; v < nodes.size(); ++v)
    if (sheet.on_border(v))
      nodes[v] = exact[v];
    else
      add(1, correction[v], nodes[v]);
  return nodes;
}

}  // namespace pelage
