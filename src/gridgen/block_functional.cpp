#include "gridgen/block_functional.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void add(double a, const Point& p, Point& sum) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += a * p[k];
}

std::array<Point, 8> corner_points(const Block& block, std::size_t cell, const std::vector<Point>& nodes) {
  std::array<Point, 8> x;
  const auto v = block.corners(cell);
  for (std::size_t k = 0; k < 8; ++k) x[k] = nodes[v[k]];
  return x;
}

}  // namespace

BlockFunctional::BlockFunctional(const Block& block, const std::vector<Point>& nodes, const GridWeights& weights,
                                 double blunt)
    : block_(block), weights_(weights), blunt_(blunt) {
  constexpr double least_smoothness = 0.01;  // as in gridgen/functional.cpp
  const double all = weights.length + weights.smoothness + weights.area + weights.orthogonality;
  weights_ = {weights.length / all, std::max(weights.smoothness / all, least_smoothness), weights.area / all,
              weights.orthogonality / all};
  const double corners = 8 * static_cast<double>(block.cells());
  volume_ = 0;
  for (std::size_t c = 0; c < block.cells(); ++c) {
    const auto x = corner_points(block, c, nodes);
    for (std::size_t k = 0; k < 8; ++k) {
      const BlockCorner corner = block_corner(x, k);
      for (std::size_t axis = 0; axis < 3; ++axis) length_[axis] += length(corner.edge[axis]) / corners;
      volume_ += corner.volume / corners;
    }
  }
  volume_ = std::abs(volume_);
}

double BlockFunctional::corner(const BlockCorner& c, std::array<Point, 3>& by_edges) const {
  const double j = c.volume / volume_;
  if (!(j > 0) && blunt_ == 0) return infinity;
  const double root = std::hypot(j, blunt_), chi = (j + root) / 2, chi_slope = (1 + j / root) / 2;
  const double power = std::cbrt(chi) * std::cbrt(chi);
  double shape = 0, angles = 0;
  for (std::size_t a = 0; a < 3; ++a) shape += dot(c.edge[a], c.edge[a]) / (length_[a] * length_[a]);
  const double smooth = weights_.smoothness * shape / (3 * power);
  const double by_j = weights_.area * j - 2. / 3 * smooth / chi * chi_slope;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
    const double along = length_[a] * length_[a], product = dot(c.edge[a], c.edge[b]);
    add((weights_.length + 2 * weights_.smoothness / (3 * power)) / along, c.edge[a], by_edges[a]);
    add(by_j / volume_, cross(c.edge[b], c.edge[d]), by_edges[a]);
    const double factor = weights_.orthogonality / (along * length_[b] * length_[b]);
    add(factor * product, c.edge[b], by_edges[a]), add(factor * product, c.edge[a], by_edges[b]);
    angles += factor * product * product / 2;
  }
  return weights_.length * shape / 2 + smooth + weights_.area * j * j / 2 + angles;
}

double BlockFunctional::operator()(const std::vector<Point>& nodes, std::vector<Point>& gradient) const {
  constexpr std::size_t chunk = 256;
  const std::size_t cells = block_.cells();
  std::vector<std::array<Point, 8>> parts(cells);
  const double sum = ordered_sum(
      cells, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double part = 0;
        for (std::size_t c = begin; c < end; ++c) {
          const auto x = corner_points(block_, c, nodes);
          for (std::size_t k = 0; k < 8; ++k) {
            std::array<Point, 3> by_edges{};
            part += corner(block_corner(x, k), by_edges);
            for (std::size_t axis = 0; axis < 3; ++axis) {
              const std::size_t bit = std::size_t{1} << axis;
              add(1, by_edges[axis], parts[c][k | bit]), add(-1, by_edges[axis], parts[c][k & ~bit]);
            }
          }
        }
        return part;
      },
      chunk);
  gradient.assign(nodes.size(), Point{});
  if (!std::isfinite(sum)) return infinity;
  const double corners = 8 * static_cast<double>(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const auto v = block_.corners(c);
    for (std::size_t k = 0; k < 8; ++k) add(1 / corners, parts[c][k], gradient[v[k]]);
  }
  return sum / corners;
}

double BlockFunctional::smallest(const std::vector<Point>& nodes) const {
  double least = infinity;
  for (std::size_t c = 0; c < block_.cells(); ++c) {
    const auto x = corner_points(block_, c, nodes);
    for (std::size_t k = 0; k < 8; ++k) least = std::min(least, block_corner(x, k).volume);
  }
  return least / volume_;
}

}  // namespace pelage
