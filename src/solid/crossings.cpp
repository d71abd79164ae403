#include "solid/crossings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/parallel.h"
#include "shape/tet_quality.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

using Whole = std::array<std::int64_t, 3>;

std::int64_t floor_of(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// Vertices in steps of 1 / `unit` edges, a multiple of 4 less 1, 1 and 2: nodes, at multiples of unit / 2, lie neither
/// on vertices nor on their shadows along any line of the lattice.
struct WholePoints {
  std::int64_t unit;
  std::vector<Whole> points;

  WholePoints(const BccLattice& lattice, const std::vector<Point>& given) {
    // Products of two differences of shadows stay below 2^62.
    constexpr int bits = 28;
    const std::int64_t most = std::max({lattice.count[0], lattice.count[1], lattice.count[2]});
    unit = std::int64_t{1} << std::max(8, bits - static_cast<int>(std::ceil(std::log2(static_cast<double>(most)))));
    for (const Point& p : given) {
      const Point u = lattice.coordinates(p);
      Whole& q = points.emplace_back();
      for (std::size_t d = 0; d < 3; ++d)
        q[d] = 4 * std::llround(u[d] * static_cast<double>(unit) / 4) - (d == 2 ? 2 : 1);
    }
  }
};

/// Parallel lines through nodes: along an axis of one of the sublattices, or along a diagonal. A shadow has the two
/// coordinates across the lines and the one along them.
struct Lines {
  int direction;
  bool middles;  ///< of axes

  Whole shadow(const Whole& q) const {
    if (BccLattice::is_long(direction)) {
      const auto d = static_cast<std::size_t>(direction);
      return {q[(d + 1) % 3], q[(d + 2) % 3], q[d]};
    }
    const auto& [dx, dy] = BccLattice::diagonals[at(direction - 3)];
    return {q[0] - dx * q[2], q[1] - dy * q[2], q[2]};
  }
  /// The first line is so far from 0.
  std::int64_t offset(std::int64_t unit) const { return middles ? unit / 2 : 0; }
  /// Between nodes along the lines.
  std::int64_t step(std::int64_t unit) const { return BccLattice::is_long(direction) ? unit : unit / 2; }
  /// The node number n (from the offset) of line (a, b).
  std::int64_t node(const BccLattice& lattice, std::int64_t a, std::int64_t b, std::int64_t n) const {
    if (BccLattice::is_long(direction)) {
      const auto d = static_cast<std::size_t>(direction);
      Whole i;
      i[(d + 1) % 3] = a, i[(d + 2) % 3] = b, i[d] = n;
      return lattice.node(middles, i[0], i[1], i[2]);
    }
    const auto& [dx, dy] = BccLattice::diagonals[at(direction - 3)];
    const std::int64_t k = floor_of(n, 2);
    const bool middle = n % 2 != 0;
    const auto index = [&](std::int64_t first, int sign) { return first + sign * k - (middle && sign < 0 ? 1 : 0); };
    return lattice.node(middle, index(a, dx), index(b, dy), k);
  }
};

/// Twice the area of (a, b, p), with the sign 1 or -1 that both triangles of an edge see opposite.
struct EdgeSide {
  std::int64_t area;
  bool left;
  EdgeSide(const Whole& a, const Whole& b, bool in_order, std::int64_t x, std::int64_t y)
      : area((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])), left(area > 0 || (area == 0 && in_order)) {}
};

void cross_triangle(const BccLattice& lattice, const WholePoints& whole, const Lines& lines, const Triangle& t,
                    std::int32_t number, std::vector<LatticeCrossing>& result) {
  std::array<Whole, 3> s;
  for (std::size_t k = 0; k < 3; ++k) s[k] = lines.shadow(whole.points[at(t[k])]);
  const std::int64_t unit = whole.unit, offset = lines.offset(unit), step = lines.step(unit);
  const auto first = [&](std::size_t d) { return floor_of(std::min({s[0][d], s[1][d], s[2][d]}) - offset, unit) + 1; };
  const auto last = [&](std::size_t d) { return floor_of(std::max({s[0][d], s[1][d], s[2][d]}) - offset, unit); };
  for (std::int64_t b = first(1); b <= last(1); ++b)
    for (std::int64_t a = first(0); a <= last(0); ++a) {
      const std::int64_t x = a * unit + offset, y = b * unit + offset;
      const auto side = [&](std::size_t k) {
        const std::size_t l = (k + 1) % 3;
        return EdgeSide(s[k], s[l], t[k] < t[l], x, y);
      };
      const EdgeSide ab = side(0), bc = side(1), ca = side(2);
      if (ab.left != bc.left || bc.left != ca.left) continue;
      const double sum = static_cast<double>(ab.area) + static_cast<double>(bc.area) + static_cast<double>(ca.area);
      if (sum == 0) continue;  // seen edge-on: its neighbours are met
      const double height = (static_cast<double>(bc.area) * static_cast<double>(s[0][2]) +
                             static_cast<double>(ca.area) * static_cast<double>(s[1][2]) +
                             static_cast<double>(ab.area) * static_cast<double>(s[2][2])) /
                            sum;
      const double nodes = (height - static_cast<double>(offset)) / static_cast<double>(step);
      const double below = std::floor(nodes);
      const std::int64_t lower = lines.node(lattice, a, b, static_cast<std::int64_t>(below));
      result.push_back({BccLattice::directions * lower + lines.direction, nodes - below, number,
                        static_cast<std::int8_t>(ab.left ? -1 : 1)});
    }
}

constexpr std::array<Lines, 10> all_lines = {{{0, false},
                                              {0, true},
                                              {1, false},
                                              {1, true},
                                              {2, false},
                                              {2, true},
                                              {3, false},
                                              {4, false},
                                              {5, false},
                                              {6, false}}};

/// Component of every triangle, by the vertices that they share.
std::vector<std::int32_t> components(const TriangleMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  for (const Triangle& t : mesh.triangles)
    for (const std::size_t k : {1, 2}) {
      const std::int32_t a = root(t[0]), b = root(t[k]);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  std::vector<std::int32_t> result;
  for (const Triangle& t : mesh.triangles) result.push_back(root(t[0]));
  return result;
}

/// Calls visit(crossing, begins a line) for those along x, line by line.
template <class Visit>
void along_x(const BccLattice& lattice, const std::vector<LatticeCrossing>& all, const Visit& visit) {
  std::int64_t line = -1;
  for (const LatticeCrossing& c : all) {
    if (c.edge % BccLattice::directions != 0) continue;
    const std::int64_t its = c.edge / BccLattice::directions / lattice.count[0];
    visit(c, its != line);
    line = its;
  }
}

/// Of a component: the fewest and the most others around its crossings.
struct Depth {
  int least = std::numeric_limits<int>::max(), most = std::numeric_limits<int>::min();
};

/// By the first vertex of a component.
std::vector<Depth> depths(const BccLattice& lattice, const std::vector<LatticeCrossing>& all,
                          const std::vector<std::int32_t>& component, std::size_t vertices) {
  std::vector<Depth> depth(vertices);
  std::vector<std::pair<std::int32_t, int>> around;  // components and their windings
  along_x(lattice, all, [&](const LatticeCrossing& c, bool begins) {
    if (begins) around.clear();
    const std::int32_t own = component[at(c.triangle)];
    int others = 0;
    auto mine = around.end();
    for (auto it = around.begin(); it != around.end(); ++it) {
      if (it->first == own)
        mine = it;
      else
        others += it->second;
    }
    depth[at(own)].least = std::min(depth[at(own)].least, others);
    depth[at(own)].most = std::max(depth[at(own)].most, others);
    if (mine == around.end())
      around.push_back({own, c.turn});
    else
      mine->second += c.turn;
  });
  return depth;
}

/// That the components enclose, by their first vertices; negative if they are turned inward.
std::vector<double> volumes(const TriangleMesh& closed, const std::vector<std::int32_t>& component) {
  std::vector<double> volume(closed.points.size(), 0.0);
  for (std::size_t f = 0; f < component.size(); ++f) {
    const Triangle& t = closed.triangles[f];
    volume[at(component[f])] += signed_volume(closed.points[at(component[f])], closed.points[at(t[0])],
                                              closed.points[at(t[1])], closed.points[at(t[2])]);
  }
  return volume;
}

/// Reverses the turns of components, by their first vertices.
void reverse(const std::vector<std::int32_t>& component, const std::vector<char>& reversed,
             std::vector<LatticeCrossing>& all) {
  for (LatticeCrossing& c : all)
    if (reversed[at(component[at(c.triangle)])]) c.turn = static_cast<std::int8_t>(-c.turn);
}

/// Turns all components outward and then the cavities inward; the volume of them all together.
double orient(const BccLattice& lattice, const TriangleMesh& closed, std::vector<LatticeCrossing>& all) {
  const std::vector<std::int32_t> component = components(closed);
  const std::vector<double> volume = volumes(closed, component);
  std::vector<char> reversed(volume.size());
  std::ranges::transform(volume, reversed.begin(), [](double v) { return v < 0; });
  reverse(component, reversed, all);
  const std::vector<Depth> depth = depths(lattice, all, component, closed.points.size());
  std::ranges::transform(depth, reversed.begin(), [](const Depth& d) { return d.least == d.most && d.least % 2 != 0; });
  reverse(component, reversed, all);
  double sum = 0;
  for (std::size_t v = 0; v < volume.size(); ++v) sum += reversed[v] ? -std::abs(volume[v]) : std::abs(volume[v]);
  return sum;
}

}  // namespace

LatticeCrossings crossings(const BccLattice& lattice, const TriangleMesh& closed) {
  const WholePoints whole(lattice, closed.points);
  constexpr std::size_t chunk = 512;
  std::vector<std::vector<LatticeCrossing>> parts(chunk_count(closed.triangles.size(), chunk));
  parallel_chunks(parts.size(), [&](std::size_t p) {
    const std::size_t end = std::min(closed.triangles.size(), (p + 1) * chunk);
    for (std::size_t f = p * chunk; f < end; ++f)
      for (const Lines& lines : all_lines)
        cross_triangle(lattice, whole, lines, closed.triangles[f], static_cast<std::int32_t>(f), parts[p]);
  });
  std::vector<LatticeCrossing> all;
  for (std::vector<LatticeCrossing>& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    part = {};
  }
  std::ranges::sort(all, [](const LatticeCrossing& a, const LatticeCrossing& b) {
    return std::tie(a.edge, a.along, a.triangle) < std::tie(b.edge, b.along, b.triangle);
  });
  const double volume = orient(lattice, closed, all);
  return {std::move(all), volume};
}

std::vector<std::int8_t> winding_numbers(const BccLattice& lattice, const std::vector<LatticeCrossing>& all) {
  std::vector<std::int8_t> winding(at(lattice.nodes()), 0);
  int current = 0;
  std::int64_t next = 0;
  along_x(lattice, all, [&](const LatticeCrossing& c, bool begins) {
    const std::int64_t lower = c.edge / BccLattice::directions;
    if (begins) current = 0;
    if (current != 0)
      std::fill(winding.begin() + next, winding.begin() + lower + 1,
                static_cast<std::int8_t>(std::clamp(current, -100, 100)));
    current += c.turn;
    next = lower + 1;
  });
  return winding;
}

double volume_along_lines(const BccLattice& lattice, const std::vector<LatticeCrossing>& all) {
  double sum = 0, entered = 0;
  int current = 0;
  along_x(lattice, all, [&](const LatticeCrossing& c, bool begins) {
    if (begins) current = 0;
    const double x = static_cast<double>(c.edge / BccLattice::directions % lattice.count[0]) + c.along;
    const bool was_inside = current > 0;
    current += c.turn;
    if (!was_inside && current > 0) entered = x;
    if (was_inside && current <= 0) sum += x - entered;
  });
  return sum / 2 * lattice.edge * lattice.edge * lattice.edge;  // corners and middles: two lines per square
}

double cut_of(std::span<const LatticeCrossing> of_edge, int winding) {
  const bool leaves = winding > 0;
  double cut = 0.5;  // rounding alone has hidden it
  for (const LatticeCrossing& c : of_edge) {
    const bool was_inside = winding > 0;
    winding += c.turn;
    if (was_inside == (winding > 0)) continue;
    cut = c.along;
    if (leaves) break;
  }
  return cut;
}

}  // namespace pelage
