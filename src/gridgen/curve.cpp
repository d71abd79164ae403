#include "gridgen/curve.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "shape/vectors.h"

namespace pelage {

namespace {

Point between(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// What lies at parameter t of a closed curve whose part begins at `from` and has the extent `extent`.
double wrapped(double t, double from, double extent) {
  const double u = from + t * extent;
  return u > 1 ? u - 1 : u;
}

}  // namespace

Curve polyline(std::vector<Point> points, const Location& where) {
  Curve curve{.at = {}, .knots = {}, .where = where};
  const double pieces = static_cast<double>(points.size() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) curve.knots.push_back(static_cast<double>(i) / pieces);
  curve.at = [points = std::move(points), pieces](std::span<const double> t) {
    std::vector<Point> result;
    for (const double s : t) {
      const double place = std::clamp(s, 0.0, 1.0) * pieces;
      const double piece = std::min(std::floor(place), pieces - 1);
      const auto i = static_cast<std::size_t>(piece);
      result.push_back(between(points[i], points[i + 1], place - piece));
    }
    return result;
  };
  return curve;
}

Curve formula_curve(std::array<FormulaFunction, 3> coordinates, const Location& where) {
  const auto shared = std::make_shared<const std::array<FormulaFunction, 3>>(std::move(coordinates));
  return {[shared](std::span<const double> t) {
            std::vector<Point> points(t.size());
            for (std::size_t k = 0; k < 3; ++k) {
              const std::vector<double> values = (*shared)[k].at({{t.begin(), t.end()}});
              for (std::size_t i = 0; i < t.size(); ++i) points[i][k] = values[i];
            }
            return points;
          },
          {0, 1},
          where};
}

Curve reversed(const Curve& curve) {
  Curve result{.at = {}, .knots = {}, .where = curve.where};
  for (auto knot = curve.knots.rbegin(); knot != curve.knots.rend(); ++knot) result.knots.push_back(1 - *knot);
  result.at = [at = curve.at](std::span<const double> t) {
    std::vector<double> turned;
    for (const double s : t) turned.push_back(1 - s);
    return at(turned);
  };
  return result;
}

Curve part(const Curve& curve, double from, double to) {
  const double extent = to > from ? to - from : to + 1 - from;
  Curve result{.at = {}, .knots = {0, 1}, .where = curve.where};
  constexpr double rounding = 1e-9;
  for (const double knot : curve.knots) {
    const double s = (knot > from ? knot - from : knot + 1 - from) / extent;
    if (s > rounding && s < 1 - rounding) result.knots.push_back(s);
  }
  std::ranges::sort(result.knots);
  const auto same = [](double a, double b) { return b - a < rounding; };
  result.knots.erase(std::unique(result.knots.begin(), result.knots.end(), same), result.knots.end());
  result.knots.back() = 1;
  result.at = [at = curve.at, from, extent](std::span<const double> t) {
    std::vector<double> moved;
    for (const double s : t) moved.push_back(wrapped(s, from, extent));
    return at(moved);
  };
  return result;
}

double CurveSamples::parameter(double wanted) const {
  const auto above = std::ranges::upper_bound(length, wanted);
  if (above == length.end()) return t.back();
  const auto i = static_cast<std::size_t>(above - length.begin());
  if (i == 0) return t.front();
  const double share = (wanted - length[i - 1]) / (length[i] - length[i - 1]);
  return t[i - 1] + share * (t[i] - t[i - 1]);
}

CurveSamples sample(const Curve& curve, std::size_t least) {
  CurveSamples samples;
  const std::size_t pieces = curve.knots.size() - 1, each = std::max<std::size_t>(2, least / pieces + 1);
  for (std::size_t k = 0; k < pieces; ++k) {
    samples.knots.push_back(samples.t.size());
    for (std::size_t i = 0; i < each; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(each);
      samples.t.push_back(curve.knots[k] + share * (curve.knots[k + 1] - curve.knots[k]));
    }
  }
  samples.knots.push_back(samples.t.size());
  samples.t.push_back(1);
  samples.points = curve.at(samples.t);
  samples.length = {0};
  for (std::size_t i = 1; i < samples.t.size(); ++i)
    samples.length.push_back(samples.length.back() + length(difference(samples.points[i], samples.points[i - 1])));
  return samples;
}

}  // namespace pelage
