#include "gridgen/volume.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "gridgen/block_functional.h"
#include "gridgen/border.h"
#include "gridgen/minimise.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using Place = std::array<std::int32_t, 3>;

void add(double a, const Point& p, Point& sum) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += a * p[k];
}

std::size_t node_at(const Block& block, const Place& p) { return block.node(p[0], p[1], p[2]); }

/// The nodes at the ends of the axes in a set, each with the product of its shares.
Point between_ends(const Block& block, const std::vector<Point>& nodes, const Place& place, unsigned axes) {
  Point sum{};
  for (unsigned ends = 0; ends < 8; ++ends) {
    if (ends & ~axes) continue;
    Place p = place;
    double share = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(axes >> k & 1u)) continue;
      const double u = static_cast<double>(place[k]) / (block.count[k] - 1);
      const bool far = ends >> k & 1u;
      share *= far ? u : 1 - u;
      p[k] = far ? block.count[k] - 1 : 0;
    }
    add(share, nodes[node_at(block, p)], sum);
  }
  return sum;
}

}  // namespace

void fill_between_faces(const Block& block, std::vector<Point>& nodes) {
  Place p{};
  for (p[2] = 1; p[2] + 1 < block.count[2]; ++p[2])
    for (p[1] = 1; p[1] + 1 < block.count[1]; ++p[1])
      for (p[0] = 1; p[0] + 1 < block.count[0]; ++p[0]) {
        Point x{};
        for (unsigned axes = 1; axes < 8; ++axes)
          add(std::popcount(axes) % 2 ? 1 : -1, between_ends(block, nodes, p, axes), x);
        nodes[node_at(block, p)] = x;
      }
}

namespace {

/// A face: its sides, the two axes that run along it, and where it lies on the third one.
struct Face {
  Sides sides;
  std::size_t along, across, fixed;
  bool far;
};

std::vector<Face> faces_of(const Volume& v) {
  const auto& [south, east, north, west] = v.bottom;
  const auto& [south_west, south_east, north_east, north_west] = v.pillars;
  return {{v.bottom, 0, 1, 2, false},
          {v.top, 0, 1, 2, true},
          {{south, south_east, v.top[0], south_west}, 0, 2, 1, false},
          {{north, north_east, v.top[2], north_west}, 0, 2, 1, true},
          {{west, north_west, v.top[3], south_west}, 1, 2, 0, false},
          {{east, north_east, v.top[1], south_east}, 1, 2, 0, true}};
}

std::vector<Point> start_of(const Region& region, const Block& block) {
  std::vector<Point> nodes(block.nodes());
  for (const Face& face : faces_of(order_edges(*region.volume))) {
    const std::array<std::int32_t, 2> count = {block.count[face.along], block.count[face.across]};
    const std::vector<Point> sheet = spanned_nodes(region, face.sides, count);
    for (std::size_t v = 0; v < sheet.size(); ++v) {
      Place p{};
      p[face.along] = static_cast<std::int32_t>(v) % count[0];
      p[face.across] = static_cast<std::int32_t>(v) / count[0];
      p[face.fixed] = face.far ? block.count[face.fixed] - 1 : 0;
      nodes[node_at(block, p)] = sheet[v];
    }
  }
  fill_between_faces(block, nodes);
  return nodes;
}

/// Moves the inner nodes down a functional, in units of its mean lengths.
Minimum descend(const Block& block, const BlockFunctional& functional, std::vector<Point>& nodes,
                const MinimiseOptions& options) {
  std::vector<std::size_t> inner;
  for (std::size_t v = 0; v < block.nodes(); ++v)
    if (!block.on_border(v)) inner.push_back(v);
  std::vector<double> x(3 * inner.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = nodes[inner[i / 3]][i % 3];
  std::vector<Point> by_nodes;
  const auto place = [&](const std::vector<double>& at) {
    for (std::size_t i = 0; i < at.size(); ++i) nodes[inner[i / 3]][i % 3] = at[i];
  };
  const Minimum minimum = minimise(
      [&](const std::vector<double>& at, std::vector<double>& gradient) {
        place(at);
        const double value = functional(nodes, by_nodes);
        for (std::size_t i = 0; i < at.size(); ++i) gradient[i] = by_nodes[inner[i / 3]][i % 3];
        return value;
      },
      x, options);
  place(x);
  return minimum;
}

}  // namespace

Untangled untangle(const Block& block, std::vector<Point>& nodes) {
  constexpr int most_rounds = 60;
  const std::vector<Point> start = nodes;
  Untangled result{first_folded(block, nodes) == block.cells(), 0};
  for (int round = 0; round < most_rounds && !result.unfolded; ++round) {
    const double worst = std::min(0.0, BlockFunctional(block, start, {}).smallest(nodes));
    const BlockFunctional blunt(block, start, {0, 1, 0, 0}, std::sqrt(1e-12 + 0.04 * worst * worst));
    result.iterations += descend(block, blunt, nodes, {200, 1e-4, 10}).iterations;
    result.unfolded = first_folded(block, nodes) == block.cells();
  }
  return result;
}

namespace {

GridQuality block_quality(const Block& block, const std::vector<Point>& nodes) {
  GridQuality q{INFINITY, 180, 0, 0, 0};
  double volumes = 0, skews = 0;
  for (std::size_t c = 0; c < block.cells(); ++c) {
    std::array<Point, 8> x;
    const auto v = block.corners(c);
    for (std::size_t k = 0; k < 8; ++k) x[k] = nodes[v[k]];
    bool folded = false;
    for (std::size_t k = 0; k < 8; ++k) {
      const BlockCorner corner = block_corner(x, k);
      q.smallest_area = std::min(q.smallest_area, corner.volume);
      volumes += corner.volume;
      folded = folded || !(corner.volume > 0);
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        const double sign = ((k >> a ^ k >> b) & 1u) ? -1 : 1;
        const Point &e = corner.edge[a], &f = corner.edge[b];
        const double angle = std::atan2(length(cross(e, f)), sign * dot(e, f)) * 180 / std::numbers::pi;
        q.smallest_angle = std::min(q.smallest_angle, angle);
        q.largest_angle = std::max(q.largest_angle, angle);
        skews += std::abs(angle - 90) / 3;
      }
    }
    q.folded += folded;
  }
  const double corners = 8 * static_cast<double>(block.cells());
  q.smallest_area /= volumes / corners;
  q.skew = skews / corners;
  return q;
}

[[noreturn]] void refuse(const Block& block, const std::vector<Point>& nodes, const Location& where) {
  const Point place = nodes[block.corners(first_folded(block, nodes))[0]];
  throw Error(Fault::numerics,
              "the grid cannot be unfolded near " + place_text(place) +
                  "; bottom and top must run anticlockwise, seen from above",
              where);
}

}  // namespace

GeneratedGrid generate_volume(const Region& region, const GenerateOptions& options) {
  Block block{{region.nodes[0], region.nodes[1], region.volume->nodes}};
  if (options.nodes) block.count = {(*options.nodes)[0], (*options.nodes)[1], region.volume->nodes};
  GeneratedGrid result;
  std::vector<Point>& nodes = result.grid.points;
  nodes = start_of(region, block);
  result.grid.count = block.count;
  result.folded_start = static_cast<double>(block_quality(block, nodes).folded) / static_cast<double>(block.cells());
  const Untangled untangled = untangle(block, nodes);
  if (!untangled.unfolded) refuse(block, nodes, region.where);
  const BlockFunctional functional(block, nodes, region.weights);
  const Minimum minimum = descend(block, functional, nodes, {.most_iterations = options.most_iterations});
  result.functional = minimum.value;
  result.iterations = untangled.iterations + minimum.iterations;
  result.converged = minimum.converged;
  result.quality = block_quality(block, nodes);
  return result;
}

}  // namespace pelage
