#include "fair/detail.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/quantile.h"
#include "fair/faces.h"
#include "fair/rings.h"

namespace pelage {

namespace {

/// Slopes of the regression below the first are chance, beyond the second details are certain: noise alone, also on
/// some vertices only, gives at most 0.14, coarse meshes with a little noise at least 0.34.
constexpr double no_detail = 0.15, all_detail = 0.3;
/// A neighbourhood holds details when its mean squared way is more than this many times that of noise, which few
/// neighbourhoods of noise alone reach.
constexpr double excess = 1.6;
/// Of noise alone the means over two rings (19 vertices) are below this share of their median at one vertex in ten.
constexpr double quiet_quantile = 0.1, quiet_share = 0.58;

struct Around {
  std::vector<double> with, without;  ///< mean of the squared ways in two rings, with and without the vertex itself
};

Around means_around(const Topology& topology, const std::vector<char>& fixed, const std::vector<double>& square) {
  const TwoRings rings(topology, fixed);
  Around mean{std::vector<double>(square.size(), 0), std::vector<double>(square.size(), 0)};
  parallel_for(
      square.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Index> near;
        for (std::size_t v = begin; v < end; ++v) {
          rings.around(static_cast<Index>(v), near);
          double sum = 0;
          for (Index w : near) sum += square[w];
          mean.with[v] = sum / static_cast<double>(near.size());
          mean.without[v] = near.size() > 1 ? (sum - square[v]) / static_cast<double>(near.size() - 1) : square[v];
        }
      },
      256);
  return mean;
}

/// Slope of the least-squares line of y over x at the free vertices; 0 if x does not vary.
double regression_slope(const std::vector<char>& fixed, const std::vector<double>& x, const std::vector<double>& y) {
  double count = 0, mean_x = 0, mean_y = 0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (fixed[v]) continue;
    ++count;
    mean_x += x[v];
    mean_y += y[v];
  }
  if (!(count > 0)) return 0;
  mean_x /= count;
  mean_y /= count;
  double xx = 0, xy = 0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (fixed[v]) continue;
    xx += (x[v] - mean_x) * (x[v] - mean_x);
    xy += (x[v] - mean_x) * (y[v] - mean_y);
  }
  return xx > 0 ? xy / xx : 0;
}

/// The mean squared way that noise alone makes: the median over the free vertices, or what the quietest tenth of them
/// lets expect, if that is less, as on coarse shapes with details nearly everywhere. Some vertices must be free.
double squared_way_of_noise(const std::vector<char>& fixed, const std::vector<double>& mean) {
  std::vector<double> all;
  for (std::size_t v = 0; v < mean.size(); ++v)
    if (!fixed[v]) all.push_back(mean[v]);
  return std::min(quantile(all, 0.5), quantile(all, quiet_quantile) / quiet_share);
}

}  // namespace

void give_back_detail(const Topology& topology, const std::vector<char>& fixed, const std::vector<Point>& from,
                      std::vector<Point>& points) {
  const std::vector<double> square = squared_ways(topology.triangles, fixed, from, points);
  const Around mean = means_around(topology, fixed, square);
  const double slope = regression_slope(fixed, mean.without, square);
  const double trust = std::clamp((slope - no_detail) / (all_detail - no_detail), 0.0, 1.0);
  if (!(trust > 0)) return;
  const double noise = excess * squared_way_of_noise(fixed, mean.with);
  std::vector<double> share(points.size(), 0);
  for (std::size_t v = 0; v < points.size(); ++v)
    if (mean.with[v] > noise) share[v] = trust * (1 - noise / mean.with[v]);
  std::vector<Index> ring;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (fixed[v]) continue;
    topology.one_ring(static_cast<Index>(v), ring);
    double sum = share[v];
    for (Index w : ring) sum += share[w];
    const double part = sum / static_cast<double>(ring.size() + 1);  // lest the parts jump from vertex to vertex
    for (std::size_t k = 0; k < 3; ++k) points[v][k] += part * (from[v][k] - points[v][k]);
  }
}

}  // namespace pelage
