#include "measure/node_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/parts.h"
#include "measure/spectrum.h"
#include "measure/spots.h"
#include "pelage/error.h"

namespace pelage {

namespace {

using std::numbers::pi;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Diameter of the disc or ball of a size.
double diameter_of(double size, int dimension) {
  return dimension == 3 ? std::cbrt(6 * size / pi) : 2 * std::sqrt(size / pi);
}

Spots spots_of(const PartNumbers& parts, const std::vector<Point>& places, const Vector& weight, int dimension) {
  std::vector<double> size(parts.count, 0);
  std::vector<Point> centre(parts.count, Point{});
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (parts.of[v] < 0) continue;
    const double share = weight[static_cast<Eigen::Index>(v)];
    size[at(parts.of[v])] += share;
    for (std::size_t d = 0; d < 3; ++d) centre[at(parts.of[v])][d] += share * places[v][d];
  }
  Spots spots;
  std::vector<Point> centres;
  for (std::size_t p = 0; p < size.size(); ++p) {
    if (!(size[p] > 0)) continue;
    for (double& x : centre[p]) x /= size[p];
    centres.push_back(centre[p]);
    spots.diameter += diameter_of(size[p], dimension);
  }
  spots.count = centres.size();
  if (spots.count > 0) spots.diameter /= static_cast<double>(spots.count);
  spots.nearest = mean_nearest(centres);
  return spots;
}

}  // namespace

PatternMeasures measure_nodes(const Space& space, int dimension, const std::vector<double>& values,
                              const std::optional<double>& level) {
  if (values.empty()) throw Error(Fault::input, "the shape has no nodes");
  PatternMeasures m;
  m.level = level ? *level : middle_level(values);
  m.minimum = std::ranges::min(values);
  m.maximum = std::ranges::max(values);
  const Vector u = Vector::Map(values.data(), std::ssize(values));
  const SparseMatrix& mass = *space.sampled(SampleRule::quadrature).mass;
  const Vector weight = mass * Vector::Ones(u.size());
  m.area = sum(weight);
  if (!(m.area > 0)) throw Error(Fault::input, "the nodes stand for nothing: the shape has no extent");
  m.mean = dot(weight, u) / m.area;
  const Vector rest = u.array() - m.mean;
  m.deviation = std::sqrt(std::max(0.0, dot(rest, mass * rest) / m.area));
  for (std::size_t v = 0; v < values.size(); ++v)
    if (values[v] > m.level) m.above.share += weight[static_cast<Eigen::Index>(v)] / m.area;
  m.below.share = 1 - m.above.share;

  const SharedMatrix stiffness = space.stiffness();
  const PartNumbers above = connected_nodes(*stiffness->pattern, values, m.level, true),
                    below = connected_nodes(*stiffness->pattern, values, m.level, false);
  m.above.parts = above.count;
  m.below.parts = below.count;
  const double slope = dot(u, *stiffness * u);
  if (m.minimum == m.maximum || !(slope > 0) || !(m.deviation > 0)) return m;
  m.wavelength = 2 * pi * m.deviation / std::sqrt(slope / m.area);
  const double each = m.area / static_cast<double>(std::max(above.count, below.count));
  m.spacing = dimension == 3 ? std::cbrt(std::numbers::sqrt2 * each) : std::sqrt(2 / std::numbers::sqrt3 * each);
  m.spots = spots_of(above.count >= below.count ? above : below, space.geometry(SampleRule::vertices, false).position,
                     weight, dimension);
  m.spectrum = spectrum(space, values, 2 * pi / m.wavelength);
  return m;
}

}  // namespace pelage
