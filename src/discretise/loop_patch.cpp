#include "discretise/loop_patch.h"

#include <algorithm>
#include <cassert>

#include "discretise/box_spline.h"
#include "shape/creases.h"
#include "shape/loop_subdivision.h"

namespace pelage {

namespace {

std::size_t ring_size(const CornerType& c) { return static_cast<std::size_t>(c.valence); }
std::size_t next_rank(const CornerType& c) { return c.position < 0 ? 0 : static_cast<std::size_t>(c.position); }

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Rank of the point across the edge from the corner to the next corner of the triangle.
std::size_t rank_across_next(const CornerType& c) {
  if (c.position < 0) return ring_size(c) - 1;
  return c.position > 0 ? next_rank(c) - 1 : none;
}

/// Rank of the point across the edge from the previous corner of the triangle to this one.
std::size_t rank_across_previous(const CornerType& c) {
  const std::size_t rank = next_rank(c) + 2;
  return rank < ring_size(c) ? rank : none;
}

/// Ranks of the corner's remaining outer points, counter-clockwise around the triangle.
std::vector<std::size_t> other_ranks(const CornerType& c) {
  std::vector<std::size_t> ranks;
  for (std::size_t rank = next_rank(c) + 3; rank < ring_size(c) - (c.position < 0 ? 1 : 0); ++rank)
    ranks.push_back(rank);
  if (c.position >= 0)
    for (std::size_t rank = 0; rank + 1 < next_rank(c); ++rank) ranks.push_back(rank);
  return ranks;
}

Index clockwise(const Topology& t, Index h) {
  const Index twin = t.twin[static_cast<std::size_t>(h)];
  return twin < 0 ? -1 : next_halfedge(twin);
}

/// Sharp edges at the origin of a half-edge inside: 0, 1, or 2 for more.
int sharp_edges(const Topology& t, Index halfedge) {
  if (!t.creases.any()) return 0;
  int count = 0;
  Index h = halfedge;
  do {
    if (t.sharp(h)) ++count;
    h = t.rotate(h);
  } while (h != halfedge && count < 2);
  return count;
}

/// Is the corner the end of a crease inside the surface?
bool is_dart(const Topology& t, Index halfedge) {
  return !t.on_boundary(t.origin(halfedge)) && sharp_edges(t, halfedge) == 1;
}

/// `whole`: also the neighbours beyond creases.
void read_corner(const Topology& t, Index halfedge, bool whole, PatchCorner& corner) {
  const Index vertex = t.origin(halfedge);
  corner.type = {};
  corner.type.fixed = t.creases.any() && t.creases.corner[static_cast<std::size_t>(vertex)];
  corner.ring.clear();
  const bool open = t.on_boundary(vertex), sector = !whole && (open || sharp_edges(t, halfedge) == 2);
  Index start = halfedge;
  if (sector && t.creases.any())
    while (!t.sharp(start)) start = clockwise(t, start);
  else if (open)
    start = t.outgoing[static_cast<std::size_t>(vertex)];
  if (sector || open) corner.type.position = 0;
  for (Index h = start; h >= 0;) {
    const auto rank = static_cast<Index>(corner.ring.size());
    if (h == halfedge && corner.type.position >= 0) corner.type.position = rank;
    if (whole && t.twin[static_cast<std::size_t>(h)] >= 0 && t.sharp(h)) corner.type.creases.push_back(rank);
    corner.ring.push_back(t.target(h));
    const Index following = t.rotate(h);
    const bool ends = following < 0 || (sector && t.sharp(previous_halfedge(h)));
    if (ends) corner.ring.push_back(t.origin(previous_halfedge(h)));
    if (ends || following == start) break;
    h = following;
  }
  corner.type.valence = static_cast<Index>(corner.ring.size());
}

void read_corners(const Topology& t, Index face, std::array<PatchCorner, 3>& corners) {
  bool whole = false;
  for (Index i = 0; i < 3; ++i) whole |= t.creases.any() && is_dart(t, 3 * face + i);
  for (Index i = 0; i < 3; ++i) read_corner(t, 3 * face + i, whole, corners[static_cast<std::size_t>(i)]);
}

/// Replaces a point (v, w) of a triangle by its parameters in the child that contains it, and returns the child.
std::size_t descend(double& v, double& w) {
  if (1 - v - w >= 0.5) {
    v *= 2, w *= 2;
    return 0;
  }
  if (v >= 0.5) {
    v = 2 * v - 1, w *= 2;
    return 1;
  }
  if (w >= 0.5) {
    v *= 2, w = 2 * w - 1;
    return 2;
  }
  v = 1 - 2 * v, w = 1 - 2 * w;
  return 3;
}

/// A polynomial patch has corners that are inside with valence 6, or on the boundary with three triangles.
bool is_regular(const PatchSignature& s) {
  return std::all_of(s.begin(), s.end(), [](const CornerType& c) {
    return c.valence == (c.position < 0 ? 6 : 4) && !c.fixed && c.creases.empty();
  });
}

using Row = Eigen::RowVectorXd;

/// The six neighbours of a corner of a regular patch, counter-clockwise from the next corner, as combinations of the
/// patch's points. A boundary corner has four real neighbours p, q1, q2, r and two reflected ones outside:
/// across (corner, p): corner + p - q1, and across (r, corner): corner + r - q2.
std::array<Row, 6> six_neighbours(const CornerType& type, const Row& corner, const std::vector<Row>& ring) {
  std::array<Row, 6> result;
  if (type.position < 0) {
    std::copy(ring.begin(), ring.end(), result.begin());
    return result;
  }
  const std::array<Row, 6> full = {
      ring[0], ring[1], ring[2], ring[3], corner + ring[3] - ring[2], corner + ring[0] - ring[1]};
  for (std::size_t i = 0; i < 6; ++i) result[i] = full[(static_cast<std::size_t>(type.position) + i) % 6];
  return result;
}

}  // namespace

bool LoopPatches::polynomial(Index c) const { return classes_[static_cast<std::size_t>(c)].expansion.size() > 0; }

/// Numbers the outer points counter-clockwise around the triangle; id[i] are the local numbers of corner i's ring.
void LoopPatches::number_points(PatchClass& patch, RingNumbers& id) {
  const PatchSignature& signature = patch.signature;
  for (std::size_t i = 0; i < 3; ++i) {
    id[i].assign(ring_size(signature[i]), -1);
    id[i][next_rank(signature[i])] = static_cast<Index>((i + 1) % 3);
    id[i][next_rank(signature[i]) + 1] = static_cast<Index>((i + 2) % 3);
  }
  patch.size = 3;
  auto number = [&](std::size_t corner, std::size_t rank) {
    if (id[corner][rank] >= 0) return;
    id[corner][rank] = patch.size++;
    patch.sources.push_back({corner, rank});
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t here = rank_across_next(signature[i]), there = rank_across_previous(signature[j]);
    if (here != none) {  // one point, seen from both ends of edge ij; at valence 3 it may have its number already
      if (id[j][there] >= 0) id[i][here] = id[j][there];
      number(i, here);
      id[j][there] = id[i][here];
    }
    for (std::size_t rank : other_ranks(signature[j])) number(j, rank);
  }
}

void LoopPatches::list_triangles(PatchClass& patch, const RingNumbers& id) {
  for (std::size_t i = 0; i < 3; ++i) {
    const CornerType& type = patch.signature[i];
    const std::size_t n = ring_size(type), spokes = type.position < 0 ? n : n - 1;
    for (std::size_t k = 0; k < spokes; ++k) {
      const std::size_t rank = (next_rank(type) + k) % spokes;
      const Triangle t = {static_cast<Index>(i), id[i][rank], id[i][(rank + 1) % n]};
      const bool known = std::any_of(patch.triangles.begin(), patch.triangles.end(), [&](const Triangle& other) {
        return other == t || other == Triangle{t[1], t[2], t[0]} || other == Triangle{t[2], t[0], t[1]};
      });
      if (!known) patch.triangles.push_back(t);
    }
  }
}

void LoopPatches::list_creases(PatchClass& patch, const RingNumbers& id) {
  for (std::size_t i = 0; i < 3; ++i)
    for (const Index rank : patch.signature[i].creases)
      patch.creases.push_back({static_cast<Index>(i), id[i][static_cast<std::size_t>(rank)]});
}

void LoopPatches::expand_to_box_spline(PatchClass& patch, const RingNumbers& id) {
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(patch.size, patch.size);
  patch.expansion.resize(static_cast<Eigen::Index>(regular_points), patch.size);
  patch.expansion.topRows(3) = unit.topRows(3);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<Row> ring;
    for (Index k : id[i]) ring.emplace_back(unit.row(k));
    const auto six = six_neighbours(patch.signature[i], unit.row(static_cast<Eigen::Index>(i)), ring);
    // The neighbours of rank 2 to 5 of corners b, c, a are r0..r3, r3..r6, r6..r0.
    const std::size_t first = 3 * ((i + 2) % 3);
    for (std::size_t k = 0; k < 4; ++k)
      patch.expansion.row(static_cast<Eigen::Index>(3 + (first + k) % 9)) = six[2 + k];
  }
}

LoopPatches::PatchClass LoopPatches::make_class(const PatchSignature& signature) {
  PatchClass patch;
  patch.signature = signature;
  RingNumbers id;
  number_points(patch, id);
  list_triangles(patch, id);
  list_creases(patch, id);
  if (is_regular(signature)) expand_to_box_spline(patch, id);
  return patch;
}

Topology LoopPatches::topology_of(const PatchClass& patch) {
  Topology t = make_topology(static_cast<std::size_t>(patch.size), patch.triangles);
  const auto is_fixed = [](const CornerType& c) { return c.fixed; };
  if (patch.creases.empty() && std::none_of(patch.signature.begin(), patch.signature.end(), is_fixed)) return t;
  t.creases = {std::vector<char>(static_cast<std::size_t>(t.edge_count), 0),
               std::vector<char>(static_cast<std::size_t>(patch.size), 0)};
  for (std::size_t i = 0; i < 3; ++i) t.creases.corner[i] = patch.signature[i].fixed;
  for (std::size_t h = 0; h < t.twin.size(); ++h)
    for (const std::array<Index, 2>& crease : patch.creases)
      if (std::minmax(crease[0], crease[1]) ==
          std::minmax(t.origin(static_cast<Index>(h)), t.target(static_cast<Index>(h))))
        t.creases.edge[static_cast<std::size_t>(t.edge[h])] = true;
  return t;
}

void LoopPatches::make_children(Index parent_class) {
  const auto parent = static_cast<std::size_t>(parent_class);
  const Topology coarse = topology_of(classes_[parent]);
  const Refinement refined = loop_refine(coarse);
  Topology fine = make_topology(refined.stencils.rows(), refined.triangles);
  fine.creases = split_creases(coarse, fine);
  for (Index child = 0; child < 4; ++child) {
    std::vector<Index> points;
    const Index child_class = classify(fine, child, points);  // of triangle 0, the patch itself; may add classes
    Eigen::MatrixXd map = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points.size()), classes_[parent].size);
    for (std::size_t r = 0; r < points.size(); ++r) {
      const auto row = static_cast<std::size_t>(points[r]);
      for (auto k = static_cast<std::size_t>(refined.stencils.start[row]);
           k < static_cast<std::size_t>(refined.stencils.start[row + 1]); ++k)
        map(static_cast<Eigen::Index>(r), refined.stencils.index[k]) += refined.stencils.weight[k];
    }
    classes_[parent].child[static_cast<std::size_t>(child)] = child_class;
    classes_[parent].child_points[static_cast<std::size_t>(child)] = std::move(map);
  }
}

void LoopPatches::make_class_and_children(const PatchSignature& signature) {
  const auto made = static_cast<Index>(classes_.size());
  by_signature_.emplace(signature, made);  // before its children, which may be of the same class
  classes_.push_back(make_class(signature));
  if (!polynomial(made)) make_children(made);
}

Index LoopPatches::classify(const Topology& topology, Index face, std::vector<Index>& points) {
  std::array<PatchCorner, 3>& corners = scratch_;
  read_corners(topology, face, corners);
  const PatchSignature signature = {corners[0].type, corners[1].type, corners[2].type};
  auto found = by_signature_.find(signature);
  if (found == by_signature_.end()) {
    make_class_and_children(signature);
    found = by_signature_.find(signature);
    read_corners(topology, face, corners);  // the making has used the scratch itself
  }
  const Triangle& triangle = topology.triangles[static_cast<std::size_t>(face)];
  points.insert(points.end(), triangle.begin(), triangle.end());
  for (const Source& s : classes_[static_cast<std::size_t>(found->second)].sources)
    points.push_back(corners[s.corner].ring[s.rank]);
  return found->second;
}

PatchJet LoopPatches::evaluate(Index patch_class, double v, double w) const {
  const PatchClass* patch = &classes_[static_cast<std::size_t>(patch_class)];
  Eigen::MatrixXd points = Eigen::MatrixXd::Identity(patch->size, patch->size);  // of the current patch
  double scale = 1;  // derivative of the current parameters by the given ones
  constexpr int deepest = 40;
  for (int depth = 0; patch->expansion.size() == 0; ++depth) {
    std::size_t child = 3;
    if (depth == deepest) {  // at an extraordinary corner: the middle of the polynomial child beside it
      v = w = 1.0 / 3;
    } else {
      child = descend(v, w);
    }
    scale *= child == 3 ? -2 : 2;
    points = patch->child_points[child] * points;
    patch = &classes_[static_cast<std::size_t>(patch->child[child])];
  }
  const BoxSplineJet spline = box_spline(v, w);
  PatchJet jet(6, 12);
  for (std::size_t d = 0; d < jet_size; ++d) {
    const double factor = d == 0 ? 1 : d < 3 ? scale : scale * scale;
    for (std::size_t i = 0; i < regular_points; ++i)
      jet(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(i)) = factor * spline[d][i];
  }
  return jet * patch->expansion * points;
}

}  // namespace pelage
