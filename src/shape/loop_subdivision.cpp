#include "shape/loop_subdivision.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "shape/creases.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using std::numbers::pi;

/// Two sharp edges pass, but where the vertex is a corner.
bool on_crease(const VertexRing& v) { return v.sharp.size() >= 2; }

void add_vertex_row(Stencils& s, Index v, const VertexRing& around) {
  const std::vector<Index>& ring = around.ring;
  if (ring.empty() || around.corner) {  // an isolated vertex stays where it is, too
    s.add(v, 1);
  } else if (on_crease(around)) {
    s.add(v, 3.0 / 4);
    s.add(ring[around.sharp[0]], 1.0 / 8);
    s.add(ring[around.sharp[1]], 1.0 / 8);
  } else {
    const double beta = loop_beta(static_cast<Index>(ring.size()));
    s.add(v, 1 - static_cast<double>(ring.size()) * beta);
    for (Index neighbour : ring) s.add(neighbour, beta);
  }
  s.end_row();
}

void add_edge_row(Stencils& s, const Topology& t, Index h) {
  const bool sharp = t.sharp(h);
  const double end_weight = sharp ? 1.0 / 2 : 3.0 / 8;
  s.add(t.origin(h), end_weight);
  s.add(t.target(h), end_weight);
  if (!sharp) {
    s.add(t.origin(previous_halfedge(h)), 1.0 / 8);
    s.add(t.origin(previous_halfedge(t.twin[static_cast<std::size_t>(h)])), 1.0 / 8);
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

/// Weights of a vertex and its ring.
struct RingWeights {
  double centre;
  std::vector<double> ring;
};

/// What the weights of a dart, the end of a crease of which ring[sharp] is the other, become when those of the next
/// level are expressed by this one. Its own rule is that of smooth vertices, the new vertex on the sharp edge is the
/// middle.
RingWeights before_dart(const RingWeights& w, std::size_t sharp) {
  const std::size_t n = w.ring.size();
  const double beta = loop_beta(static_cast<Index>(n));
  RingWeights result{(1 - static_cast<double>(n) * beta) * w.centre, std::vector<double>(n, beta * w.centre)};
  for (std::size_t i = 0; i < n; ++i) {
    const double own = i == sharp ? 1.0 / 2 : 3.0 / 8;
    result.centre += own * w.ring[i];
    result.ring[i] += own * w.ring[i];
    if (i == sharp) continue;
    result.ring[(i + 1) % n] += w.ring[i] / 8;
    result.ring[(i + n - 1) % n] += w.ring[i] / 8;
  }
  return result;
}

/// The left eigenvector to which weights tend, or those whose sum is 0; its largest entry is 1.
RingWeights dart_eigenvector(RingWeights w, std::size_t sharp, bool sum_is_0) {
  constexpr int most = 20'000;  // a valence of 40 needs some 1000
  for (int i = 0; i < most; ++i) {
    RingWeights next = before_dart(w, sharp);
    if (sum_is_0) next.centre = -std::accumulate(next.ring.begin(), next.ring.end(), 0.0);  // else rounding would grow
    double largest = std::abs(next.centre), change = 0;
    for (double x : next.ring) largest = std::max(largest, std::abs(x));
    next.centre /= largest;
    for (std::size_t k = 0; k < next.ring.size(); ++k) {
      next.ring[k] /= largest;
      change = std::max(change, std::abs(next.ring[k] - w.ring[k]));
    }
    w = std::move(next);
    if (change < 1e-16) break;
  }
  return w;
}

void add_dart_limit(Stencils& s, Index v, const VertexRing& around) {
  RingWeights w = dart_eigenvector({1, std::vector<double>(around.ring.size(), 0)}, around.sharp[0], false);
  const double sum = std::accumulate(w.ring.begin(), w.ring.end(), w.centre);
  s.add(v, w.centre / sum);
  for (std::size_t i = 0; i < w.ring.size(); ++i) s.add(around.ring[i], w.ring[i] / sum);
}

/// Along the crease the left eigenvector that is symmetric to it; across that of smooth vertices, which is 0 on it.
void add_dart_tangents(LimitMasks& masks, Index v, const VertexRing& around) {
  const std::size_t n = around.ring.size(), sharp = around.sharp[0];
  RingWeights along{-1, std::vector<double>(n, 0)};
  along.ring[sharp] = 1;
  along = dart_eigenvector(std::move(along), sharp, true);
  masks.tangent1.add(v, along.centre);
  for (std::size_t i = 0; i < n; ++i) {
    masks.tangent1.add(around.ring[i], along.ring[i]);
    masks.tangent2.add(around.ring[i],
                       std::sin(2 * pi * static_cast<double>((i + n - sharp) % n) / static_cast<double>(n)));
  }
}

/// Of a sector whose two ends are sharp. At a corner the surface touches both ends (with four triangles or more that
/// are not in one plane it has no tangent plane there).
void add_sector_tangents(LimitMasks& masks, Index v, const std::vector<Index>& part, bool corner) {
  if (!corner) return add_boundary_tangents(masks, v, part);
  masks.tangent1.add(v, -1);
  masks.tangent1.add(part.front(), 1);
  masks.tangent2.add(v, -1);
  masks.tangent2.add(part.back(), 1);
}

/// Cubic B-spline (1, 4, 1) / 6 on creases; elsewhere 1 - n chi and chi with chi = 1 / (n + 3 / (8 beta)).
void add_limit_row(Stencils& s, Index v, const VertexRing& around) {
  const std::vector<Index>& ring = around.ring;
  if (ring.empty() || around.corner) {
    s.add(v, 1);
  } else if (on_crease(around)) {
    s.add(v, 2.0 / 3);
    s.add(ring[around.sharp[0]], 1.0 / 6);
    s.add(ring[around.sharp[1]], 1.0 / 6);
  } else if (!around.sharp.empty()) {
    add_dart_limit(s, v, around);
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
  VertexRing around;
  for (Index v = 0; v < t.vertex_count; ++v) {
    vertex_ring(t, v, around);
    add_vertex_row(fine.stencils, v, around);
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

void add_tangent_rows(LimitMasks& masks, Index v, const VertexRing& around) {
  if (on_crease(around))
    add_sector_tangents(masks, v, sector(around, 0), around.corner);
  else if (!around.sharp.empty())
    add_dart_tangents(masks, v, around);
  else
    add_interior_tangents(masks, around.ring);
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
    VertexRing around;
    for (Index v = begin; v < end; ++v) {
      vertex_ring(t, v, around);
      add_limit_row(rows, v, around);
      rows.end_row();
    }
    return combine(rows, control);
  });
}

}  // namespace

LimitMasks loop_limit_masks(const Topology& t) {
  LimitMasks masks;
  for (Stencils* s : {&masks.position, &masks.tangent1, &masks.tangent2}) s->columns = t.vertex_count;
  VertexRing around;
  for (Index v = 0; v < t.vertex_count; ++v) {
    vertex_ring(t, v, around);
    add_limit_row(masks.position, v, around);
    masks.position.end_row();
    add_tangent_rows(masks, v, around);
  }
  return masks;
}

std::vector<double> loop_limits(const Topology& t, const std::vector<double>& control) { return limits(t, control); }
std::vector<Point> loop_limits(const Topology& t, const std::vector<Point>& control) { return limits(t, control); }

namespace {

std::vector<Point> limit_normals(const LimitMasks& rows, const std::vector<Point>& control) {
  std::vector<Point> normals = combine(rows.tangent1, control);
  const std::vector<Point> other = combine(rows.tangent2, control);
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unit(cross(normals[i], other[i]));
  return normals;
}

/// The sum of the normals of a sector's triangles.
Point fan_normal(const std::vector<Point>& control, Index v, const std::vector<Index>& part) {
  const auto from_v = [&](Index i) {
    return difference(control[static_cast<std::size_t>(i)], control[static_cast<std::size_t>(v)]);
  };
  Point sum{};
  for (std::size_t i = 0; i + 1 < part.size(); ++i) {
    const Point n = cross(from_v(part[i]), from_v(part[i + 1]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return sum;
}

/// Corners may be concave, or straight, where two tangents do not tell the side.
Point corner_sector_normal(const std::vector<Point>& control, Index v, const std::vector<Index>& part) {
  const auto from_v = [&](Index i) {
    return unit(difference(control[static_cast<std::size_t>(i)], control[static_cast<std::size_t>(v)]));
  };
  const Point n = cross(from_v(part.front()), from_v(part.back())), side = unit(fan_normal(control, v, part));
  constexpr double straight = 0.05;  // sine
  if (length(n) < straight) return side;
  const double sign = dot(n, side) < 0 ? -1 : 1;
  return unit({sign * n[0], sign * n[1], sign * n[2]});
}

Point sector_normal(const std::vector<Point>& control, Index v, const std::vector<Index>& part, bool corner) {
  if (corner) return corner_sector_normal(control, v, part);
  LimitMasks rows;
  add_boundary_tangents(rows, v, part);
  rows.tangent1.end_row();
  rows.tangent2.end_row();
  return limit_normals(rows, control)[0];
}

}  // namespace

std::vector<Point> loop_limit_normals(const Topology& t, const std::vector<Point>& control) {
  return by_rows<Point>(t, [&](Index begin, Index end) {
    LimitMasks rows;
    VertexRing around;
    for (Index v = begin; v < end; ++v) {
      vertex_ring(t, v, around);
      add_tangent_rows(rows, v, around);
    }
    std::vector<Point> normals = limit_normals(rows, control);
    for (Index v = begin; t.creases.any() && v < end; ++v) {
      vertex_ring(t, v, around);
      if (!on_crease(around)) continue;
      Point sum{};
      for (std::size_t i = 0; i < sector_count(around); ++i) {
        const Point n = sector_normal(control, v, sector(around, i), around.corner);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
      }
      normals[static_cast<std::size_t>(v - begin)] = unit(sum);
    }
    return normals;
  });
}

CornerNormals::CornerNormals(const Topology& t, const std::vector<Point>& control)
    : triangles_(t.triangles), normals_(loop_limit_normals(t, control)) {
  if (!t.creases.any()) return;
  triangles_ = cut_at_creases(t).triangles;
  VertexRing around;
  for (Index v = 0; v < t.vertex_count; ++v) {
    vertex_ring(t, v, around);
    if (!on_crease(around)) continue;
    for (std::size_t i = 0; i < sector_count(around); ++i) {  // in the order in which the mesh is cut
      const Point n = sector_normal(control, v, sector(around, i), around.corner);
      if (i == 0)
        normals_[static_cast<std::size_t>(v)] = n;
      else
        normals_.push_back(n);
    }
  }
}

}  // namespace pelage
