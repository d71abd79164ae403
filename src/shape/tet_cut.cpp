#include "shape/tet_cut.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "base/checked.h"
#include "shape/convex_cell.h"
#include "shape/tet_mesh.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Of the size of the volume: what is so near to a plane is meant to lie on it, and floats tell no difference.
constexpr double on_plane = 1e-7;

constexpr std::uint8_t inside = 0, skin = 1;  // labels of sides; those of the k-th cut are skin + k, from 1

/// Kuhn's six tetrahedra of a cube, whose corners are numbered by the bits of their offset (x = 1, y = 2, z = 4): the
/// monotone paths from corner 0 to corner 7, the last two columns of odd ones exchanged to turn all alike.
constexpr std::array<std::array<std::size_t, 4>, 6> kuhn = {
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 1, 7, 5}, {0, 2, 7, 3}, {0, 4, 7, 6}}};

std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32 |
         static_cast<std::uint32_t>(std::max(a, b));
}

Point between(const Point& p, const Point& q, double part) {
  return {p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1]), p[2] + part * (q[2] - p[2])};
}

}  // namespace

/// Takes tetrahedra one by one through all cuts and keeps what is on the surface of what is left.
class Carver {
 public:
  Carver(std::size_t nodes, std::span<const Cut> cuts) : cuts_(cuts), on_(cuts.size()), behind_(cuts.size()) {
    assert(cuts.size() < 255);
    body_.nodes_ = checked_count<std::int32_t>(nodes, "nodes");
    for (const Cut& cut : cuts) {
      assert(cut.values.size() == nodes);
      double largest = 0;
      for (const double x : cut.values) largest = std::max(largest, std::abs(x));
      near_.push_back(on_plane * largest);
    }
  }

  /// Whether no cut comes near.
  bool untouched(std::span<const std::int32_t> corners) const {
    return std::ranges::all_of(cuts_, [&](const Cut& cut) {
      const auto all = [&](auto&& test) {
        return std::ranges::all_of(corners, [&](auto v) { return test(cut.values[static_cast<std::size_t>(v)]); });
      };
      return all([](double x) { return x > 0; }) || all([](double x) { return x < 0; });
    });
  }
  /// Whether all is cut away.
  bool gone(std::span<const std::int32_t> corners) const {
    bool below = true;
    for (const Cut& cut : cuts_) {
      below =
          below && std::ranges::all_of(corners, [&](auto v) { return cut.values[static_cast<std::size_t>(v)] <= 0; });
      if (cut.and_next) continue;
      if (below) return true;
      below = true;
    }
    return false;
  }

  void add(const LabelledTet& tet) {
    if (gone(tet.corner) || (tet.label == std::array<std::uint8_t, 4>{} && untouched(tet.corner))) return;
    now_.assign(1, {tet, 0});
    std::size_t first = 0;
    for (std::size_t k = 0; k < cuts_.size() && !now_.empty(); ++k) {
      const bool alone = first == k && !cuts_[k].and_next;
      next_.clear();
      for (const Part& part : now_) cut(part, k, 1U << (k - first), alone);
      std::swap(now_, next_);
      if (cuts_[k].and_next) continue;
      take_away(first, k);
      first = k + 1;
    }
    for (const Part& part : now_) keep_surface(part.tet);
  }

  CarvedBody body() {
    number_vertices();
    return std::move(body_);
  }

 private:
  double value(std::size_t k, std::int32_t v) const {
    const std::int32_t n = body_.nodes_;
    return v < n ? cuts_[k].values[static_cast<std::size_t>(v)] : behind_[k][static_cast<std::size_t>(v - n)];
  }

  /// Where the k-th cut meets the edge between two vertices on different sides of it.
  std::int32_t crossing(std::size_t k, std::int32_t a, std::int32_t b) {
    if (a > b) std::swap(a, b);
    const auto next =
        checked_count<std::int32_t>(static_cast<std::size_t>(body_.nodes_) + body_.ways_.size(), "vertices");
    const auto [entry, is_new] = on_[k].try_emplace(edge_key(a, b), next);
    if (!is_new) return entry->second;
    const double from = value(k, a), to = value(k, b);
    constexpr double margin = 0.01;
    const double part = cuts_[k].plane ? from / (from - to) : std::clamp(from / (from - to), margin, 1 - margin);
    body_.ways_.push_back({a, b, part});
    for (std::size_t i = 0; i < cuts_.size(); ++i) behind_[i].push_back(i == k ? 0 : value_between(i, a, b, part));
    return next;
  }

  /// Of another cut; a plane that passes so near goes through.
  double value_between(std::size_t i, std::int32_t a, std::int32_t b, double part) const {
    const double from = value(i, a), to = value(i, b), x = from + part * (to - from);
    if (cuts_[i].plane) return std::abs(x) <= near_[i] ? 0 : x;
    return x == 0 ? -std::numeric_limits<double>::min() : x;
  }

  /// A part of a tetrahedron, and above which of the cuts that belong together it lies: bits from the first of them.
  struct Part {
    LabelledTet tet;
    std::uint32_t above;
  };

  /// `alone`: nothing below 0 is left.
  void cut(const Part& part, std::size_t k, std::uint32_t bit, bool alone) {
    std::array<double, 4> at{};
    std::ranges::transform(part.tet.corner, at.begin(), [&](std::int32_t v) { return value(k, v); });
    const auto positive = std::ranges::count_if(at, [](double x) { return x > 0; });
    const auto negative = std::ranges::count_if(at, [](double x) { return x < 0; });
    if (positive > 0 && negative > 0) {
      keep_parts(part_of(part.tet, at, k), part.above | bit);
      for (double& x : at) x = -x;
      if (!alone) keep_parts(part_of(part.tet, at, k), part.above);
    } else if (positive > 0 || !alone) {
      next_.push_back({with_sides_on(part.tet, at, k), positive > 0 ? part.above | bit : part.above});
    }
  }

  void keep_parts(const ConvexCell& cell, std::uint32_t above) {
    tets_.clear();
    append_tets(cell, tets_);
    for (const LabelledTet& tet : tets_) next_.push_back({tet, above});
  }

  /// What is below all cuts from `first` to `last`. Behind a side on one of them that is where the part itself is above
  /// no other.
  void take_away(std::size_t first, std::size_t last) {
    std::erase_if(now_, [](const Part& part) { return part.above == 0; });
    for (Part& part : now_) {
      for (std::size_t k = first; k <= last; ++k)
        if (part.above != 1U << (k - first)) std::ranges::replace(part.tet.label, label_of(k), inside);
      part.above = 0;
    }
  }

  static std::uint8_t label_of(std::size_t k) { return static_cast<std::uint8_t>(skin + k + 1); }

  /// With the label of the cut at a side that lies in it.
  static LabelledTet with_sides_on(LabelledTet tet, const std::array<double, 4>& at, std::size_t k) {
    for (std::size_t i = 0; i < 4; ++i) {
      const bool on = std::ranges::all_of(tet_sides[i], [&](std::size_t c) { return at[c] == 0; });
      if (on && tet.label[i] == inside) tet.label[i] = label_of(k);
    }
    return tet;
  }

  /// The part above 0 of a tetrahedron with corners on both sides.
  ConvexCell part_of(const LabelledTet& tet, const std::array<double, 4>& at, std::size_t k) {
    ConvexCell cell;
    std::array<std::array<std::int32_t, 2>, 4> rim{};  // edges of the cut, as it has them
    std::size_t rims = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::int32_t, 4> loop{};
      std::array<bool, 4> on{};
      std::size_t n = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t here = tet_sides[i][c], there = tet_sides[i][(c + 1) % 3];
        if (at[here] >= 0) on[n] = at[here] == 0, loop[n++] = tet.corner[here];
        if ((at[here] < 0 && at[there] > 0) || (at[here] > 0 && at[there] < 0))
          on[n] = true, loop[n++] = crossing(k, tet.corner[here], tet.corner[there]);
      }
      if (n < 3) continue;
      cell.add_face({loop.data(), n}, tet.label[i]);
      for (std::size_t c = 0; c < n; ++c)
        if (on[c] && on[(c + 1) % n]) rim[rims++] = {loop[(c + 1) % n], loop[c]};
    }
    add_cut_face({rim.data(), rims}, label_of(k), cell);
    return cell;
  }

  static void add_cut_face(std::span<const std::array<std::int32_t, 2>> rim, std::uint8_t label, ConvexCell& cell) {
    std::array<std::int32_t, 4> loop{};
    std::size_t n = 0;
    for (std::int32_t v = rim[0][0]; n < rim.size();) {
      loop[n++] = v;
      v = (*std::ranges::find(rim, v, [](const auto& edge) { return edge[0]; }))[1];
    }
    cell.add_face({loop.data(), n}, label);
  }

  void keep_surface(const LabelledTet& tet) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (tet.label[i] == inside) continue;
      body_.triangles.push_back(
          {tet.corner[tet_sides[i][0]], tet.corner[tet_sides[i][1]], tet.corner[tet_sides[i][2]]});
      body_.side.push_back(static_cast<std::uint8_t>(tet.label[i] - skin));
    }
  }

  /// Those of the triangles, in their own order.
  void number_vertices() {
    std::vector<std::int32_t>& used = body_.vertex_;
    for (const Triangle& t : body_.triangles) used.insert(used.end(), t.begin(), t.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    used.shrink_to_fit();
    for (Triangle& t : body_.triangles)
      for (std::int32_t& v : t) v = static_cast<std::int32_t>(std::ranges::lower_bound(used, v) - used.begin());
  }

  std::span<const Cut> cuts_;
  CarvedBody body_;
  std::vector<std::unordered_map<std::uint64_t, std::int32_t>> on_;  ///< per cut, by edges
  std::vector<double> near_;                                         ///< per cut, see on_plane
  std::vector<std::vector<double>> behind_;  ///< per cut, its values at vertices behind the nodes
  std::vector<Part> now_, next_;
  std::vector<LabelledTet> tets_;
};

// --- values on a body ---

std::vector<double> CarvedBody::at_vertices(const std::vector<double>& at_nodes, std::size_t components) const {
  std::vector<double> behind;
  behind.reserve(components * ways_.size());
  const auto at = [&](std::int32_t v) {
    return v < nodes_ ? &at_nodes[components * static_cast<std::size_t>(v)]
                      : &behind[components * static_cast<std::size_t>(v - nodes_)];
  };
  for (const Way& way : ways_)
    for (std::size_t k = 0; k < components; ++k) {
      const double from = at(way.from)[k];
      behind.push_back(from + way.part * (at(way.to)[k] - from));
    }
  std::vector<double> values;
  values.reserve(components * vertex_.size());
  for (const std::int32_t v : vertex_) values.insert(values.end(), at(v), at(v) + components);
  return values;
}

Attribute CarvedBody::at_vertices(const Attribute& attribute) const {
  const auto n = static_cast<std::size_t>(attribute.components);
  Attribute result{attribute.name, attribute.components, Domain::vertex, {}, attribute.type, attribute.labels};
  if (attribute.labels.empty()) {
    result.values = at_vertices(attribute.values, n);
    widen(result);
    return result;
  }
  CarvedBody nearer = *this;
  for (Way& way : nearer.ways_) way.part = way.part < 0.5 ? 0 : 1;
  result.values = nearer.at_vertices(attribute.values, n);
  return result;
}

std::vector<Point> CarvedBody::places(const std::vector<Point>& nodes) const {
  std::vector<Point> behind;
  behind.reserve(ways_.size());
  const auto at = [&](std::int32_t v) -> const Point& {
    return v < nodes_ ? nodes[static_cast<std::size_t>(v)] : behind[static_cast<std::size_t>(v - nodes_)];
  };
  for (const Way& way : ways_) behind.push_back(between(at(way.from), at(way.to), way.part));
  std::vector<Point> result;
  result.reserve(vertex_.size());
  for (const std::int32_t v : vertex_) result.push_back(at(v));
  return result;
}

void CarvedBody::refine() {
  std::unordered_map<std::uint64_t, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [entry, is_new] =
        middles.try_emplace(edge_key(a, b), checked_count<std::int32_t>(vertex_.size(), "vertices"));
    if (is_new) {
      vertex_.push_back(checked_count<std::int32_t>(static_cast<std::size_t>(nodes_) + ways_.size(), "vertices"));
      ways_.push_back(
          {vertex_[static_cast<std::size_t>(std::min(a, b))], vertex_[static_cast<std::size_t>(std::max(a, b))], 0.5});
    }
    return entry->second;
  };
  std::vector<Triangle> finer;
  std::vector<std::uint8_t> finer_side;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& part : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(part);
    finer_side.insert(finer_side.end(), 4, side[t]);
  }
  triangles = std::move(finer);
  side = std::move(finer_side);
}

// --- volumes ---

CarvedBody carve(const TetMesh& volume, std::span<const Cut> cuts) {
  Carver carver(volume.nodes(), cuts);
  const std::vector<std::uint8_t> on_skin = skin_sides(volume);
  for (std::size_t t = 0; t < volume.tets.size(); ++t) {
    LabelledTet tet{volume.tets[t], {}};
    for (std::size_t i = 0; i < 4; ++i) tet.label[i] = (on_skin[t] >> i & 1) != 0 ? skin : inside;
    carver.add(tet);
  }
  return carver.body();
}

namespace {

/// Whether the first cell turns its axes as a right hand does.
bool right_handed(const Grid& grid) {
  const Point origin = grid.point(0);
  const auto edge = [&](std::int32_t node) { return difference(grid.point(node), origin); };
  return dot(cross(edge(grid.node(1, 0, 0)), edge(grid.node(0, 1, 0))), edge(grid.node(0, 0, 1))) > 0;
}

/// Bit 2 d for the lower and 2 d + 1 for the upper end of axis d that a cell lies at.
unsigned ends_of(const Grid& block, const std::array<std::int32_t, 3>& cell) {
  unsigned ends = 0;
  for (std::size_t d = 0; d < 3; ++d)
    ends |= (cell[d] == 0 ? 1U : 0U) << 2 * d | (cell[d] == block.count[d] - 2 ? 2U : 0U) << 2 * d;
  return ends;
}

/// At which ends of a cell a side of one of its tetrahedra lies, whose corners are numbers of corners of the cell.
unsigned ends_of(std::size_t a, std::size_t b, std::size_t c) {
  unsigned ends = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::size_t bit = std::size_t{1} << d;
    if ((a & b & c & bit) != 0) ends |= 2U << 2 * d;
    if (((a | b | c) & bit) == 0) ends |= 1U << 2 * d;
  }
  return ends;
}

void add_cell(const std::array<std::int32_t, 8>& corner, unsigned ends, bool mirrored, Carver& carver) {
  for (const auto& path : kuhn) {
    LabelledTet tet{};
    for (std::size_t k = 0; k < 4; ++k) {
      tet.corner[k] = corner[path[k]];
      const bool on_skin = (ends & ends_of(path[tet_sides[k][0]], path[tet_sides[k][1]], path[tet_sides[k][2]])) != 0;
      tet.label[k] = on_skin ? skin : inside;
    }
    if (mirrored) {
      std::swap(tet.corner[2], tet.corner[3]);
      std::swap(tet.label[2], tet.label[3]);
    }
    carver.add(tet);
  }
}

}  // namespace

CarvedBody carve(const Grid& block, std::span<const Cut> cuts) {
  assert(block.dimension() == 3);
  Carver carver(block.nodes(), cuts);
  const bool mirrored = !right_handed(block);
  for (std::int32_t k = 0; k + 1 < block.count[2]; ++k)
    for (std::int32_t j = 0; j + 1 < block.count[1]; ++j)
      for (std::int32_t i = 0; i + 1 < block.count[0]; ++i) {
        std::array<std::int32_t, 8> corner{};
        for (std::int32_t c = 0; c < 8; ++c)
          corner[static_cast<std::size_t>(c)] = block.node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
        const unsigned ends = ends_of(block, {i, j, k});
        if ((ends != 0 || !carver.untouched(corner)) && !carver.gone(corner)) add_cell(corner, ends, mirrored, carver);
      }
  return carver.body();
}

// --- cuts ---

Cut plane_cut(const std::vector<Point>& nodes, const Point& normal, double offset) {
  Cut cut{{}, true};
  double largest = 0;
  for (const Point& p : nodes) {
    cut.values.push_back(offset - dot(normal, p));
    largest = std::max(largest, std::abs(cut.values.back()));
  }
  for (double& x : cut.values)
    if (std::abs(x) <= on_plane * largest) x = 0;
  return cut;
}

Cut level_cut(const std::vector<double>& values, double level) {
  Cut cut;
  for (const double x : values) cut.values.push_back(x == level ? -std::numeric_limits<double>::min() : x - level);
  return cut;
}

}  // namespace pelage
