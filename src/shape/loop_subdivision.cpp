#include "shape/loop_subdivision.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using std::numbers::pi;

void add_vertex_row(Stencils& s, Index v, const std::vector<Index>& ring, bool boundary) {
  if (ring.empty()) {  // an isolated vertex stays where it is
    s.add(v, 1);
  } else if (boundary) {
    s.add(v, 3.0 / 4);
    s.add(ring.front(), 1.0 / 8);
    s.add(ring.back(), 1.0 / 8);
  } else {
    const double beta = loop_beta(static_cast<Index>(ring.size()));
    s.add(v, 1 - static_cast<double>(ring.size()) * beta);
    for (Index neighbour : ring) s.add(neighbour, beta);
  }
  s.end_row();
}

void add_edge_row(Stencils& s, const Topology& t, Index h) {
  const Index twin = t.twin[static_cast<std::size_t>(h)];
  const double end_weight = twin < 0 ? 1.0 / 2 : 3.0 / 8;
  s.add(t.origin(h), end_weight);
  s.add(t.target(h), end_weight);
  if (twin >= 0) {
    s.add(t.origin(previous_halfedge(h)), 1.0 / 8);
    s.add(t.origin(previous_halfedge(twin)), 1.0 / 8);
  }
  s.end_row();
}

/// Calls visit(h) once for every edge, in the order of the edge numbers.
template <class Visit>
void for_each_edge(const Topology& t, Visit visit) {
  for (std::size_t h = 0; h < t.twin.size(); ++h)
    if (t.twin[h] < 0 || static_cast<std::size_t>(t.twin[h]) > h) visit(static_cast<Index>(h));
}

/// Tangents at an interior vertex: the left eigenvectors of the subdominant eigenvalue of the subdivision matrix.
void add_interior_tangents(LimitMasks& masks, const std::vector<Index>& ring) {
  const auto n = static_cast<double>(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / n;
    masks.tangent1.add(ring[i], std::cos(angle));
    masks.tangent2.add(ring[i], std::sin(angle));
  }
}

/// Tangents at a boundary vertex with k triangles: along the boundary, and the left eigenvector w of the subdivision
/// matrix that is symmetric under reversal of the ring, eigenvalue 3/8 + cos(pi/k)/4 (k = 1: 1/4). In the interior of
/// the ring w_i = sin(i pi / k); w_0 = w_k and the centre's weight follow from the columns of p_0 and of the centre:
///   (lambda - 1/2) w_0 - w_v / 8       = w_1 / 8
///               -w_0 * 1 + (lambda - 3/4) w_v = 3/8 sum(w_1 .. w_{k-1})
void add_boundary_tangents(LimitMasks& masks, Index v, const std::vector<Index>& ring) {
  masks.tangent1.add(ring.front(), 1);
  masks.tangent1.add(ring.back(), -1);
  const std::size_t k = ring.size() - 1;
  double end = 1, centre = -2;
  if (k > 1) {
    const double theta = pi / static_cast<double>(k);
    const double lambda = 3.0 / 8 + std::cos(theta) / 4;
    double sum = 0;
    for (std::size_t i = 1; i < k; ++i) sum += std::sin(static_cast<double>(i) * theta);
    const double a = lambda - 0.5, b = -0.125, c = -1, d = lambda - 0.75;
    const double r1 = std::sin(theta) / 8, r2 = 3.0 / 8 * sum;
    const double det = a * d - b * c;
    end = (r1 * d - b * r2) / det;
    centre = (a * r2 - c * r1) / det;
    for (std::size_t i = 1; i < k; ++i) masks.tangent2.add(ring[i], std::sin(static_cast<double>(i) * theta));
  }
  masks.tangent2.add(v, centre);
  masks.tangent2.add(ring.front(), end);
  masks.tangent2.add(ring.back(), end);
}

/// Cubic B-spline (1, 4, 1) / 6 on the boundary; inside 1 - n chi and chi with chi = 1 / (n + 3 / (8 beta)).
void add_limit_row(Stencils& s, Index v, const std::vector<Index>& ring, bool boundary) {
  if (ring.empty()) {
    s.add(v, 1);
  } else if (boundary) {
    s.add(v, 2.0 / 3);
    s.add(ring.front(), 1.0 / 6);
    s.add(ring.back(), 1.0 / 6);
  } else {
    const auto n = static_cast<double>(ring.size());
    const double chi = 1 / (n + 3 / (8 * loop_beta(static_cast<Index>(ring.size()))));
    s.add(v, 1 - n * chi);
    for (Index neighbour : ring) s.add(neighbour, chi);
  }
}

}  // namespace

double loop_beta(Index valence) {
  const auto n = static_cast<double>(valence);
  const double c = 3.0 / 8 + std::cos(2 * pi / n) / 4;
  return (5.0 / 8 - c * c) / n;
}

std::vector<Triangle> split_triangles(const Topology& t) {
  std::vector<Triangle> fine;
  fine.reserve(4 * t.triangles.size());
  for (std::size_t f = 0; f < t.triangles.size(); ++f) {
    const auto [a, b, c] = t.triangles[f];
    const Index ab = t.vertex_count + t.edge[3 * f];
    const Index bc = t.vertex_count + t.edge[3 * f + 1];
    const Index ca = t.vertex_count + t.edge[3 * f + 2];
    fine.insert(fine.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}});
  }
  return fine;
}

Refinement loop_refine(const Topology& t) {
  Refinement fine;
  fine.triangles = split_triangles(t);
  fine.stencils.columns = t.vertex_count;
  std::vector<Index> ring;
  for (Index v = 0; v < t.vertex_count; ++v) {
    t.one_ring(v, ring);
    add_vertex_row(fine.stencils, v, ring, t.on_boundary(v));
  }
  for_each_edge(t, [&](Index h) { add_edge_row(fine.stencils, t, h); });
  return fine;
}

Refinement midpoint_refine(const Topology& t) {
  Refinement fine;
  fine.triangles = split_triangles(t);
  fine.stencils.columns = t.vertex_count;
  for (Index v = 0; v < t.vertex_count; ++v) {
    fine.stencils.add(v, 1);
    fine.stencils.end_row();
  }
  for_each_edge(t, [&](Index h) {
    fine.stencils.add(t.origin(h), 0.5);
    fine.stencils.add(t.target(h), 0.5);
    fine.stencils.end_row();
  });
  return fine;
}

namespace {

void add_tangent_rows(LimitMasks& masks, const Topology& t, Index v, const std::vector<Index>& ring) {
  const bool boundary = t.on_boundary(v);
  if (!ring.empty() && boundary) add_boundary_tangents(masks, v, ring);
  if (!boundary) add_interior_tangents(masks, ring);
  masks.tangent1.end_row();
  masks.tangent2.end_row();
}

/// Values at all vertices, some thousands at a time: of_rows(begin, end) gives those of a range.
template <class Value, class OfRows>
std::vector<Value> by_rows(const Topology& t, OfRows&& of_rows) {
  std::vector<Value> result(static_cast<std::size_t>(t.vertex_count));
  parallel_for(result.size(), [&](std::size_t begin, std::size_t end) {
    const std::vector<Value> part = of_rows(static_cast<Index>(begin), static_cast<Index>(end));
    std::copy(part.begin(), part.end(), result.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return result;
}

template <class Value>
std::vector<Value> limits(const Topology& t, const std::vector<Value>& control) {
  return by_rows<Value>(t, [&](Index begin, Index end) {
    Stencils rows;
    std::vector<Index> ring;
    for (Index v = begin; v < end; ++v) {
      t.one_ring(v, ring);
      add_limit_row(rows, v, ring, t.on_boundary(v));
      rows.end_row();
    }
    return combine(rows, control);
  });
}

}  // namespace

LimitMasks loop_limit_masks(const Topology& t) {
  LimitMasks masks;
  for (Stencils* s : {&masks.position, &masks.tangent1, &masks.tangent2}) s->columns = t.vertex_count;
  std::vector<Index> ring;
  for (Index v = 0; v < t.vertex_count; ++v) {
    t.one_ring(v, ring);
    add_limit_row(masks.position, v, ring, t.on_boundary(v));
    masks.position.end_row();
    add_tangent_rows(masks, t, v, ring);
  }
  return masks;
}

std::vector<double> loop_limits(const Topology& t, const std::vector<double>& control) { return limits(t, control); }
std::vector<Point> loop_limits(const Topology& t, const std::vector<Point>& control) { return limits(t, control); }

std::vector<Point> loop_limit_normals(const Topology& t, const std::vector<Point>& control) {
  return by_rows<Point>(t, [&](Index begin, Index end) {
    LimitMasks rows;
    std::vector<Index> ring;
    for (Index v = begin; v < end; ++v) {
      t.one_ring(v, ring);
      add_tangent_rows(rows, t, v, ring);
    }
    std::vector<Point> normals = combine(rows.tangent1, control);
    const std::vector<Point> other = combine(rows.tangent2, control);
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unit(cross(normals[i], other[i]));
    return normals;
  });
}

}  // namespace pelage
