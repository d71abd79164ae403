#include "shape/editable_mesh.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"

namespace pelage {

EditableMesh::EditableMesh(const Topology& topology)
    : outgoing_(topology.outgoing), valence_(topology.outgoing.size(), 0) {
  halves_.resize(topology.twin.size());
  for (std::size_t h = 0; h < halves_.size(); ++h) {
    halves_[h] = {topology.origin(static_cast<Index>(h)), topology.twin[h]};
    ++valence_of(halves_[h].origin);
    if (halves_[h].twin < 0) ++valence_of(topology.target(static_cast<Index>(h)));
  }
  live_faces_ = static_cast<Index>(topology.triangles.size());
  live_vertices_ =
      static_cast<Index>(std::count_if(outgoing_.begin(), outgoing_.end(), [](Index h) { return h >= 0; }));
}

bool EditableMesh::adjacent(Index a, Index b) const {
  bool found = false;
  around(a, [&](Index v) { found |= v == b; });
  return found;
}

void EditableMesh::join(Index a, Index b) {
  if (a >= 0) at(a).twin = b;
  if (b >= 0) at(b).twin = a;
}

void EditableMesh::set_line(Index h, Index line) {
  lines_.resize(halves_.size(), 0);
  lines_[static_cast<std::size_t>(h)] = line;
  if (twin(h) >= 0) lines_[static_cast<std::size_t>(twin(h))] = -line;
}

/// Where a half-edge becomes another.
void EditableMesh::take_line(Index to, Index from) {
  if (!lines_.empty()) lines_[static_cast<std::size_t>(to)] = line(from);
}

/// Returns the first half-edge of the new triangle.
Index EditableMesh::add_face(Index a, Index b, Index c) {
  const Index first = halfedge_count();
  halves_.insert(halves_.end(), {{a, -1}, {b, -1}, {c, -1}});
  if (!lines_.empty()) lines_.resize(halves_.size(), 0);
  ++live_faces_;
  return first;
}

/// Triangle abc with h = ab becomes (a, middle, c) and a new one, (middle, b, c), whose first half-edge is returned.
Index EditableMesh::split_side(Index h, Index middle) {
  const Index n = next_halfedge(h), b = origin(n), c = origin(previous_halfedge(h)), beyond = twin(n);
  const Index fresh = add_face(middle, b, c);
  if (outgoing(b) == n) outgoing_of(b) = fresh + 1;
  at(n).origin = middle;
  take_line(fresh, h);
  take_line(fresh + 1, n);
  if (!lines_.empty()) lines_[static_cast<std::size_t>(n)] = 0;
  join(fresh + 1, beyond);
  join(fresh + 2, n);
  ++valence_of(c);
  return fresh;
}

Index EditableMesh::split(Index h) {
  const Index g = twin(h), middle = vertex_count();
  const Index ahead = split_side(h, middle);
  outgoing_.push_back(ahead);
  valence_.push_back(g < 0 ? 3 : 4);
  ++live_vertices_;
  if (g < 0) return middle;
  const Index behind = split_side(g, middle);
  join(h, behind);
  join(g, ahead);
  return middle;
}

bool EditableMesh::may_flip(Index h) const {
  const Index g = twin(h);
  if (g < 0) return false;
  const Index a = origin(h), b = origin(g), c = origin(previous_halfedge(h)), d = origin(previous_halfedge(g));
  const auto can_lose = [&](Index v) { return valence(v) > (on_boundary(v) ? 2 : 3); };
  return c != d && can_lose(a) && can_lose(b) && !adjacent(c, d);
}

void EditableMesh::flip(Index h) {
  const Index g = twin(h), n = next_halfedge(h), p = previous_halfedge(h);
  const Index gn = next_halfedge(g), gp = previous_halfedge(g);
  const Index a = origin(h), b = origin(g), c = origin(p), d = origin(gp);
  const Index bc = twin(n), ca = twin(p), ad = twin(gn), db = twin(gp);
  if (outgoing(a) == h || outgoing(a) == gn) outgoing_of(a) = p;
  if (outgoing(b) == g || outgoing(b) == n) outgoing_of(b) = gp;
  if (outgoing(c) == p) outgoing_of(c) = n;
  if (outgoing(d) == gp) outgoing_of(d) = gn;
  const std::array<Index, 4> lines = {line(p), line(gn), line(gp), line(n)};  // of ca, ad, db, bc
  for (std::size_t k = 0; !lines_.empty() && k < 4; ++k)
    lines_[static_cast<std::size_t>(std::array{n, p, gn, gp}[k])] = lines[k];
  at(h).origin = d, at(n).origin = c, at(p).origin = a;
  at(g).origin = c, at(gn).origin = d, at(gp).origin = b;
  at(n).twin = at(p).twin = at(gn).twin = at(gp).twin = -1;
  join(n, ca), join(p, ad), join(gn, db), join(gp, bc);
  --valence_of(a), --valence_of(b), ++valence_of(c), ++valence_of(d);
}

bool EditableMesh::may_collapse(Index h) const {
  const Index g = twin(h), a = origin(h), b = target(h);
  if (g >= 0 && on_boundary(a) && on_boundary(b)) return false;
  const auto can_lose = [&](Index side) {
    const Index v = origin(previous_halfedge(side));
    return valence(v) > (on_boundary(v) ? 2 : 3);
  };
  if (!can_lose(h) || (g >= 0 && !can_lose(g))) return false;
  int common = 0;
  const Index few = valence(a) < valence(b) ? a : b, many = few == a ? b : a;
  around(many, [&](Index v) {
    bool shared = false;
    around(few, [&](Index w) { shared |= v == w; });
    common += shared;
  });
  return common == (g < 0 ? 1 : 2);
}

/// Takes out the triangle abc of h = ab after b became a: its other two sides become one. Returns a half-edge from a
/// that stays.
Index EditableMesh::remove_face(Index h) {
  const Index n = next_halfedge(h), p = previous_halfedge(h), c = origin(p);
  const Index from_c = twin(n), to_c = twin(p);
  if (line(n) != 0 && to_c >= 0) take_line(to_c, n);      // n and to_c both end at c
  if (line(p) != 0 && from_c >= 0) take_line(from_c, p);  // p and from_c both begin there
  --valence_of(c);
  if (outgoing(c) == p) outgoing_of(c) = from_c;
  if (from_c >= 0) at(from_c).twin = to_c;
  if (to_c >= 0) at(to_c).twin = from_c;
  at(h).origin = at(n).origin = at(p).origin = -1;
  --live_faces_;
  return to_c >= 0 ? to_c : next_halfedge(from_c);
}

void EditableMesh::collapse(Index h) {
  const Index g = twin(h), a = origin(h), b = target(h);
  valence_of(a) += valence(b) - (g < 0 ? 3 : 4);
  const Index start = outgoing(b);
  for (Index k = start; k >= 0;) {
    at(k).origin = a;
    k = twin(previous_halfedge(k));
    if (k == start) break;
  }
  outgoing_of(b) = -1;
  --live_vertices_;
  const Index left = remove_face(h);
  if (g >= 0) remove_face(g);
  Index first = left;  // on the boundary: back clockwise to the first
  while (twin(first) >= 0) {
    first = next_halfedge(twin(first));
    if (first == left) break;
  }
  outgoing_of(a) = first;
}

/// Each component from its last vertex, which after an earlier packing is the one farthest from the first: narrow
/// rings, so near numbers.
std::vector<Index> EditableMesh::breadth_first() const {
  std::vector<Index> order;
  order.reserve(static_cast<std::size_t>(live_vertices_));
  std::vector<char> seen(outgoing_.size(), false);
  const auto meet = [&](Index v) {
    char& known = seen[static_cast<std::size_t>(v)];
    if (!known) order.push_back(v);
    known = true;
  };
  std::size_t next = 0;
  for (Index v = vertex_count() - 1; v >= 0; --v) {
    if (vertex_alive(v)) meet(v);
    for (; next < order.size(); ++next) around(order[next], meet);
  }
  return order;
}

/// The live triangles in the order of their smallest new vertex.
std::vector<Index> EditableMesh::faces_by_vertex(const std::vector<Index>& order,
                                                 const std::vector<Index>& number) const {
  const auto visit_own = [&](Index v, auto&& visit) {  // the triangles whose smallest vertex is v
    const auto later = [&](Index w) {
      return number[static_cast<std::size_t>(w)] > number[static_cast<std::size_t>(v)];
    };
    const Index start = outgoing(v);
    for (Index h = start; h >= 0;) {
      if (later(target(h)) && later(origin(previous_halfedge(h)))) visit(h / 3);
      h = twin(previous_halfedge(h));
      if (h == start) break;
    }
  };
  std::vector<std::vector<Index>> parts(chunk_count(order.size()));
  parallel_for(order.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Index>& part = parts[begin / default_chunk];
    part.reserve(2 * (end - begin));
    for (std::size_t i = begin; i < end; ++i) visit_own(order[i], [&](Index f) { part.push_back(f); });
  });
  std::vector<Index> faces;
  faces.reserve(static_cast<std::size_t>(live_faces_));
  for (const std::vector<Index>& part : parts) faces.insert(faces.end(), part.begin(), part.end());
  return faces;
}

namespace {

/// The place of each entry in a list of different numbers below `count`; -1 for numbers that are not there.
std::vector<Index> inverse(const std::vector<Index>& list, std::size_t count) {
  std::vector<Index> result(count, -1);
  parallel_for(list.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result[static_cast<std::size_t>(list[i])] = static_cast<Index>(i);
  });
  return result;
}

}  // namespace

std::vector<Index> EditableMesh::pack() {
  std::vector<Index> vertices = breadth_first();
  const std::vector<Index> number = inverse(vertices, outgoing_.size());
  const std::vector<Index> faces = faces_by_vertex(vertices, number);
  const std::vector<Index> face_number = inverse(faces, halves_.size() / 3);

  const auto renumbered = [&](Index h) {
    return h < 0 ? -1 : 3 * face_number[static_cast<std::size_t>(h / 3)] + h % 3;
  };
  std::vector<Half> halves(3 * faces.size());
  parallel_for(halves.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Half& half = at(3 * faces[i / 3] + static_cast<Index>(i % 3));
      halves[i] = {number[static_cast<std::size_t>(half.origin)], renumbered(half.twin)};
    }
  });
  std::vector<Index> outgoing(vertices.size()), valence(vertices.size());
  parallel_for(vertices.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      outgoing[i] = renumbered(this->outgoing(vertices[i]));
      valence[i] = this->valence(vertices[i]);
    }
  });
  if (!lines_.empty()) {
    std::vector<Index> lines(halves.size());
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = line(3 * faces[i / 3] + static_cast<Index>(i % 3));
    lines_ = std::move(lines);
  }
  halves_ = std::move(halves);
  outgoing_ = std::move(outgoing);
  valence_ = std::move(valence);
  return vertices;
}

Topology EditableMesh::topology() const {
  Topology result;
  result.vertex_count = vertex_count();
  result.triangles.resize(halves_.size() / 3);
  result.twin.resize(halves_.size());
  parallel_for(halves_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h) {
      result.triangles[h / 3][h % 3] = halves_[h].origin;
      result.twin[h] = halves_[h].twin;
    }
  });
  number_from_twins(result);
  if (!lines_.empty()) {
    result.creases = {std::vector<char>(static_cast<std::size_t>(result.edge_count), 0),
                      std::vector<char>(static_cast<std::size_t>(result.vertex_count), 0)};
    for (std::size_t h = 0; h < lines_.size(); ++h)
      if (lines_[h] != 0) result.creases.edge[static_cast<std::size_t>(result.edge[h])] = true;
  }
  return result;
}

}  // namespace pelage
