#include "solid/fill.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/box.h"
#include "base/number.h"
#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/edges.h"
#include "shape/finding.h"
#include "shape/locate.h"
#include "shape/tet_quality.h"
#include "solid/crossings.h"
#include "solid/pinches.h"
#include "solid/stencil.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::string text_of(const Point& p) {
  return "(" + number(p[0], 4) + ", " + number(p[1], 4) + ", " + number(p[2], 4) + ")";
}

void require_closed(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh.triangles, mesh.points.size());
  std::size_t open = 0, first = 0;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() % 2 != 0 && open++ == 0) first = e;
  if (mesh.triangles.empty()) throw Error(Fault::input, "the shape has no faces that could enclose a volume");
  if (open == 0) return;
  const Point& place = mesh.points[at(tail(mesh.triangles, edges[first][0]))];
  throw Error(Fault::input, "the shape is open, and has no inside to fill: " + counted(open, "edge") +
                                " with one face only, the first at " + text_of(place) +
                                "; close its holes, or let the coat grow on the surface");
}

/// Before any work, by the volume that the triangles enclose.
void require_moderate(const TriangleMesh& mesh, const BccLattice& lattice, std::size_t max_tets) {
  const Point& o = mesh.points.front();
  double volume = 0;
  for (const Triangle& t : mesh.triangles)
    volume += signed_volume(o, mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])]);
  const double cube = lattice.edge * lattice.edge * lattice.edge;
  const double tets = BccLattice::tets_per_cube * std::abs(volume) / cube;
  // A node of the lattice that is not used costs a twentieth of a tetrahedron.
  const double all = std::max(tets, static_cast<double>(lattice.nodes()) / 20);
  if (all <= static_cast<double>(max_tets)) return;
  throw Error(Fault::input, "edges of " + number(lattice.edge, 3) + " would fill the shape with about " +
                                number(std::round(tets / 1e6)) + " million tetrahedra, more than the " +
                                number(static_cast<double>(max_tets) / 1e6) +
                                " million that are allowed; ask for a larger pattern or fewer edges per wavelength");
}

/// A place of the surface on an edge of the lattice.
struct Cut {
  std::int64_t edge;
  double along;
};

/// The lattice with its nodes moved to the surface where this is near.
struct WarpedLattice {
  BccLattice lattice;
  std::vector<Side> side;           ///< of nodes
  std::vector<std::int32_t> moved;  ///< of nodes: to that cut, or -1
  std::vector<Cut> cuts;            ///< by edges

  Point place(const Cut& cut) const {
    const std::int64_t lower = cut.edge / BccLattice::directions;
    const Point a = lattice.point(lower);
    const Point b = lattice.point(lattice.next(lower, static_cast<int>(cut.edge % BccLattice::directions)));
    return {a[0] + cut.along * (b[0] - a[0]), a[1] + cut.along * (b[1] - a[1]), a[2] + cut.along * (b[2] - a[2])};
  }
  /// Keys: nodes, and behind them the cuts.
  Point place(std::int64_t key) const {
    if (key >= lattice.nodes()) return place(cuts[at(key - lattice.nodes())]);
    return moved[at(key)] >= 0 ? place(cuts[at(moved[at(key)])]) : lattice.point(key);
  }
  std::int64_t key_of_cut(std::int64_t a, std::int64_t b) const {
    const std::int64_t edge = lattice.edge_between(a, b);
    const auto cut = std::ranges::lower_bound(cuts, edge, {}, &Cut::edge);
    return lattice.nodes() + (cut - cuts.begin());
  }
};

/// Concatenates what body(begin, end, part) appends to its part for all chunks of [0, n), in order.
template <class Value, class Body>
std::vector<Value> gather(std::int64_t n, std::size_t chunk, const Body& body) {
  std::vector<std::vector<Value>> parts(chunk_count(at(n), chunk));
  parallel_chunks(parts.size(), [&](std::size_t p) {
    body(static_cast<std::int64_t>(p * chunk), std::min(n, static_cast<std::int64_t>((p + 1) * chunk)), parts[p]);
  });
  std::vector<Value> all;
  for (std::vector<Value>& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    part = {};
  }
  return all;
}

constexpr std::size_t nodes_per_chunk = 1 << 15;

std::vector<Cut> find_cuts(const BccLattice& lattice, const std::vector<LatticeCrossing>& all,
                           const std::vector<std::int8_t>& winding) {
  return gather<Cut>(lattice.nodes(), nodes_per_chunk, [&](std::int64_t begin, std::int64_t end, auto& part) {
    for (std::int64_t n = begin; n < end; ++n)
      for (int d = 0; d < BccLattice::directions; ++d) {
        const std::int64_t upper = lattice.next(n, d);
        if (upper < 0 || (winding[at(n)] > 0) == (winding[at(upper)] > 0)) continue;
        const std::int64_t edge = BccLattice::directions * n + d;
        // Clang before 16 has no ranges of iterators, which equal_range() would return.
        const auto first = std::ranges::lower_bound(all, edge, {}, &LatticeCrossing::edge);
        const auto last = std::ranges::upper_bound(first, all.end(), edge, {}, &LatticeCrossing::edge);
        part.push_back({edge, cut_of({std::to_address(first), std::to_address(last)}, winding[at(n)])});
      }
  });
}

/// As shares of long and short edges: nearer cuts draw their node to them. With these the smallest dihedral angle that
/// any stencil can have is 10.7 degrees, and the largest 164.3: tests/solid/stencil_test.cpp looks for worse ones.
constexpr double long_reach = 0.286, short_reach = 0.398;

/// Every node goes to the nearest of the cuts in its reach, of equally near ones the first.
void warp(WarpedLattice& w) {
  const BccLattice& lattice = w.lattice;
  w.moved.assign(w.side.size(), -1);
  const auto draw = [&](std::int64_t node, std::int32_t cut, int direction, double share) {
    const bool is_long = BccLattice::is_long(direction);
    if (share > (is_long ? long_reach : short_reach)) return;
    std::int32_t& old = w.moved[at(node)];
    const auto length = [&](double part, bool of_long) { return part * (of_long ? 1 : std::sqrt(0.75)); };
    if (old >= 0) {
      const Cut& other = w.cuts[at(old)];
      const bool from_below = other.edge / BccLattice::directions == node;
      const double before = length(from_below ? other.along : 1 - other.along,
                                   BccLattice::is_long(static_cast<int>(other.edge % BccLattice::directions)));
      if (before <= length(share, is_long)) return;
    }
    old = cut;
  };
  for (std::size_t c = 0; c < w.cuts.size(); ++c) {
    const std::int64_t lower = w.cuts[c].edge / BccLattice::directions;
    const int direction = static_cast<int>(w.cuts[c].edge % BccLattice::directions);
    draw(lower, static_cast<std::int32_t>(c), direction, w.cuts[c].along);
    draw(lattice.next(lower, direction), static_cast<std::int32_t>(c), direction, 1 - w.cuts[c].along);
  }
  for (std::size_t n = 0; n < w.side.size(); ++n)
    if (w.moved[n] >= 0) w.side[n] = Side::on;
}

using KeyTet = std::array<std::int64_t, 4>;

/// The tetrahedra inside one of the lattice, as keys.
class Cutter {
 public:
  explicit Cutter(const WarpedLattice& w) : w_(w) {}

  void cut(const std::array<std::int64_t, 4>& nodes, std::vector<KeyTet>& result) {
    std::array<Side, 4> side;
    for (std::size_t c = 0; c < 4; ++c) side[c] = w_.side[at(nodes[c])];
    if (std::ranges::none_of(side, [](Side s) { return s == Side::inside; })) return;
    std::array<bool, 4> even;
    for (std::size_t c = 0; c < 4; ++c) even[c] = w_.lattice.is_even(nodes[c]);
    stencil_.clear();
    cut_tetrahedron(side, even, true, stencil_);
    const bool free =
        side[0] == side[1] && side[2] == side[3] && side[0] != side[2] && std::ranges::count(side, Side::on) == 0;
    const std::size_t begin = result.size();
    append(nodes, result);
    if (!free) return;
    // Of the two diagonals of the four cuts the one with the better angles.
    const double angle = smallest_angle(result, begin);
    const std::vector<KeyTet> first(result.begin() + static_cast<std::ptrdiff_t>(begin), result.end());
    result.resize(begin);
    stencil_.clear();
    cut_tetrahedron(side, even, false, stencil_);
    append(nodes, result);
    if (smallest_angle(result, begin) > angle) return;
    std::ranges::copy(first, result.begin() + static_cast<std::ptrdiff_t>(begin));
  }

 private:
  void append(const std::array<std::int64_t, 4>& nodes, std::vector<KeyTet>& result) const {
    for (const StencilTet& t : stencil_) {
      KeyTet& keys = result.emplace_back();
      for (std::size_t c = 0; c < 4; ++c)
        keys[c] = t[c].a == t[c].b ? nodes[at(t[c].a)] : w_.key_of_cut(nodes[at(t[c].a)], nodes[at(t[c].b)]);
    }
  }
  double smallest_angle(const std::vector<KeyTet>& tets, std::size_t begin) const {
    double smallest = 180;
    for (std::size_t k = begin; k < tets.size(); ++k) {
      std::array<Point, 4> p;
      for (std::size_t c = 0; c < 4; ++c) p[c] = w_.place(tets[k][c]);
      smallest = std::min(smallest, dihedral_angles(p).first);
    }
    return smallest;
  }

  const WarpedLattice& w_;
  std::vector<StencilTet> stencil_;
};

std::vector<KeyTet> stuff(const WarpedLattice& w) {
  return gather<KeyTet>(w.lattice.corners(), nodes_per_chunk, [&](std::int64_t begin, std::int64_t end, auto& part) {
    Cutter cutter(w);
    std::array<std::int64_t, 4> nodes;
    for (std::int64_t corner = begin; corner < end; ++corner)
      for (int k = 0; k < BccLattice::tets_per_cube; ++k)
        if (w.lattice.tetrahedron(corner, k, nodes)) cutter.cut(nodes, part);
  });
}

/// Nodes that are used, in the order of their keys.
TetMesh numbered(const WarpedLattice& w, const std::vector<KeyTet>& tets) {
  std::vector<std::int32_t> place(at(w.lattice.nodes()) + w.cuts.size(), -1);
  for (const KeyTet& t : tets)
    for (const std::int64_t key : t) place[at(key)] = 0;
  TetMesh mesh;
  for (std::size_t key = 0; key < place.size(); ++key)
    if (place[key] == 0) {
      place[key] = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.push_back(w.place(static_cast<std::int64_t>(key)));
    }
  mesh.tets.reserve(tets.size());
  for (const KeyTet& t : tets) {
    Tetrahedron& n = mesh.tets.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) n[c] = place[at(t[c])];
    if (signed_volume(mesh.points[at(n[0])], mesh.points[at(n[1])], mesh.points[at(n[2])], mesh.points[at(n[3])]) < 0)
      std::swap(n[2], n[3]);
  }
  return mesh;
}

/// The values of an attribute of the surface at a place of it.
void append_value(const Attribute& a, const TriangleMesh& surface, const MeshPlace& place,
                  std::vector<double>& values) {
  const auto n = at(a.components);
  const Triangle& t = surface.triangles[at(place.face)];
  const std::array<double, 3> weight = {1 - place.v - place.w, place.v, place.w};
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
      sum += weight[c] * a.values[n * (a.domain == Domain::vertex ? at(t[c]) : 3 * at(place.face) + c) + k];
    values.push_back(sum);
  }
}

void carry_attributes(const TriangleMesh& surface, TetMesh& volume) {
  std::vector<const Attribute*> carried;
  for (const Attribute& a : surface.attributes)
    if (a.domain != Domain::face && a.name != "normal") carried.push_back(&a);
  if (carried.empty()) return;
  const SurfaceWalk walk(make_topology(surface.points.size(), surface.triangles), surface.points);
  std::vector<MeshPlace> place(volume.nodes());
  parallel_for(place.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Point& p = volume.points[v];
      place[v] = walk.search({p[0], p[1], p[2]}, Eigen::Vector3d::Zero());
    }
  });
  for (const Attribute* a : carried) {
    Attribute values = *a;
    values.domain = Domain::vertex;
    values.values.clear();
    for (const MeshPlace& p : place) append_value(*a, surface, p, values.values);
    widen(values);
    volume.set(std::move(values));
  }
}

}  // namespace

Filling fill(const TriangleMesh& closed, double edge, std::size_t max_tets) {
  require_closed(closed);
  const Box box = box_of(closed.points);
  WarpedLattice w;
  w.lattice = BccLattice::around(box.low, box.high, edge);
  require_moderate(closed, w.lattice, max_tets);
  const auto [all, volume] = crossings(w.lattice, closed);
  double enclosed = volume;
  {
    const std::vector<std::int8_t> winding = winding_numbers(w.lattice, all);
    if (*std::ranges::max_element(winding) > 1) enclosed = volume_along_lines(w.lattice, all);
    w.cuts = find_cuts(w.lattice, all, winding);
    w.side.resize(winding.size());
    std::ranges::transform(winding, w.side.begin(), [](int n) { return n > 0 ? Side::inside : Side::outside; });
  }
  warp(w);
  std::vector<KeyTet> tets = stuff(w);
  remove_pinches(
      tets, [&](std::int64_t key) { return key >= w.lattice.nodes() || w.moved[at(key)] >= 0; },
      [&](const KeyTet& t) {
        return std::abs(signed_volume(w.place(t[0]), w.place(t[1]), w.place(t[2]), w.place(t[3])));
      });
  Filling result{numbered(w, tets), edge, 0};
  if (result.volume.tets.empty())
    throw Error(Fault::input,
                "edges of " + number(edge, 3) +
                    " are too long to fill the shape; ask for a smaller pattern or more edges per wavelength");
  result.lost = enclosed > 0 ? 1 - volume_of(result.volume) / enclosed : 0;
  result.volume.metres_per_unit = closed.metres_per_unit;
  carry_attributes(closed, result.volume);
  return result;
}

Filling fill_within(const TriangleMesh& closed, double edge, double share, std::size_t max_tets) {
  Filling filling = fill(closed, edge, max_tets);
  // What edges, corners and bends lose goes with the square of the edge, what is thin with more.
  constexpr double least_share = 0.5;
  constexpr int steps = 3;
  for (int step = 0; step < steps && filling.lost > share && filling.edge > least_share * edge; ++step) {
    const double wanted = filling.edge * std::min(0.95, std::sqrt(0.9 * share / filling.lost));
    const double shorter = std::max(wanted, least_share * edge);
    const double tets = static_cast<double>(filling.volume.tets.size()) * std::pow(filling.edge / shorter, 3);
    if (tets > 0.9 * static_cast<double>(max_tets)) break;
    filling = fill(closed, shorter, max_tets);
  }
  return filling;
}

}  // namespace pelage
