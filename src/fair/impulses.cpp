#include "fair/impulses.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/quantile.h"
#include "fair/faces.h"
#include "fair/rings.h"
#include "shape/normals.h"

namespace pelage {

namespace {

/// Fewer vertices say nothing about distributions.
constexpr std::size_t fewest = 100;
/// The kurtosis of noise of one kind is 2.8 to 3.3 on the meshes that were looked at, that of impulses 4.7 and more.
constexpr double least_kurtosis = 4;
/// Noise on some vertices makes ways of other lengths than what the filter does to the others; less may be noise of
/// one kind with rare large values.
constexpr double least_ratio = 4;
/// Vertices that have noise after all cannot be held: when the others are put back, the ways become shorter than this
/// share of what they were. Without noise they come to a third, on coarse shapes with details to two thirds; with
/// noise to nine tenths at least.
constexpr double largest_rest = 0.8;
/// Ways of this share of the loud ones are never called noise, lest fewer and fewer vertices are put back.
constexpr double least_quiet = 0.03;
/// So often vertices are told apart; after each time the loud ones move alone, and then all.
constexpr int passes = 6, steps_alone = 3, steps_of_all = 2, steps_at_end = 10;
constexpr int rounds_of_fit = 60;

/// The way of every free vertex along its present normal, less the median of those around it: what is common to a
/// neighbourhood is shape.
std::vector<double> own_ways(const FairState& s, const std::vector<Point>& from) {
  const std::vector<Point> normal = vertex_normals(s.topology.triangles, s.points);
  std::vector<double> way(s.points.size(), 0), own = way;
  for (std::size_t v = 0; v < way.size(); ++v) way[v] = vector3(normal[v]).dot(vector3(s.points[v]) - vector3(from[v]));
  const TwoRings rings(s.topology, s.fixed);
  parallel_for(
      way.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Index> near;
        std::vector<double> others;
        for (std::size_t v = begin; v < end; ++v) {
          if (s.fixed[v]) continue;
          rings.around(static_cast<Index>(v), near);
          others.clear();
          for (const Index w : near)
            if (w != static_cast<Index>(v)) others.push_back(way[w]);
          own[v] = others.empty() ? way[v] : way[v] - quantile(others, 0.5);
        }
      },
      256);
  return own;
}

std::vector<double> at_free(const std::vector<char>& fixed, const std::vector<double>& values) {
  std::vector<double> result;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (!fixed[v]) result.push_back(values[v]);
  return result;
}

double kurtosis(const std::vector<double>& values) {
  double squares = 0, fourths = 0;
  for (const double x : values) squares += x * x, fourths += x * x * x * x;
  return squares > 0 ? fourths * static_cast<double>(values.size()) / (squares * squares) : 0;
}

/// The probability that a value is from the second distribution.
double loudness(const TwoNormals& m, double x) {
  const auto density = [&](double share, double deviation) {
    return share / deviation * std::exp(-x * x / (2 * deviation * deviation));
  };
  const double quiet = density(m.share, m.quiet), loud = density(1 - m.share, m.loud);
  return loud / (quiet + loud);
}

/// Puts the quiet vertices back and holds them.
std::size_t put_back(FairState& s, const std::vector<Point>& from, const std::vector<double>& way,
                     const TwoNormals& m) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < way.size(); ++v) {
    if (s.fixed[v] || loudness(m, way[v]) > 0.5) continue;
    s.points[v] = from[v];
    s.fixed[v] = 1;
    ++count;
  }
  return count;
}

void take_steps(FairMethod& method, int count, FairState& s, FairReport& report) {
  for (int step = 0; step < count; ++step) method.step(s, report);
}

}  // namespace

TwoNormals fit_two_normals(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double squares = 0;
  for (const double x : values) squares += x * x;
  const double deviation = std::sqrt(squares / count);
  TwoNormals m{deviation / 4, 1.5 * deviation, 0.5};
  for (int round = 0; round < rounds_of_fit && m.loud > 0; ++round) {
    double loud = 0, loud_squares = 0;
    for (const double x : values) {
      const double p = loudness(m, x);
      loud += p;
      loud_squares += p * x * x;
    }
    if (!(loud > 0 && loud < count)) break;
    m = {std::sqrt(std::max(0.0, squares - loud_squares) / (count - loud)), std::sqrt(loud_squares / loud),
         1 - loud / count};
    m.quiet = std::max(m.quiet, least_quiet * m.loud);
  }
  return m;
}

std::size_t settle_impulses(FairState& s, const std::vector<Point>& from, FairMethod& method, FairReport& report) {
  const std::vector<char> fixed = s.fixed;
  const std::vector<Point> before = s.points;
  std::vector<double> way = own_ways(s, from);
  const std::vector<double> free_way = at_free(fixed, way);
  if (free_way.size() < fewest || kurtosis(free_way) < least_kurtosis) return 0;
  const TwoNormals first = fit_two_normals(free_way);
  if (first.loud < least_ratio * first.quiet) return 0;
  TwoNormals m = first;
  for (int pass = 1; pass < passes; ++pass) {
    put_back(s, from, way, m);
    take_steps(method, steps_alone, s, report);
    s.fixed = fixed;
    take_steps(method, steps_of_all, s, report);
    way = own_ways(s, from);
    m = fit_two_normals(at_free(fixed, way));
    m.share = first.share;
    if (pass == 1 && m.quiet > largest_rest * first.quiet) {
      s.points = before;
      return 0;
    }
  }
  const std::size_t count = put_back(s, from, way, m);
  take_steps(method, steps_at_end, s, report);
  s.fixed = fixed;
  return count;
}

}  // namespace pelage
