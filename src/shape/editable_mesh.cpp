#include "shape/editable_mesh.h"

#include <algorithm>

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

/// Returns the first half-edge of the new triangle.
Index EditableMesh::add_face(Index a, Index b, Index c) {
  const Index first = halfedge_count();
  halves_.insert(halves_.end(), {{a, -1}, {b, -1}, {c, -1}});
  ++live_faces_;
  return first;
}

/// Triangle abc with h = ab becomes (a, middle, c) and a new one, (middle, b, c), whose first half-edge is returned.
Index EditableMesh::split_side(Index h, Index middle) {
  const Index n = next_halfedge(h), b = origin(n), c = origin(previous_halfedge(h)), beyond = twin(n);
  const Index fresh = add_face(middle, b, c);
  if (outgoing(b) == n) outgoing_of(b) = fresh + 1;
  at(n).origin = middle;
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
std::vector<Index> EditableMesh::faces_by_vertex(const std::vector<Index>& number, std::size_t vertices) const {
  const auto smallest = [&](Index f) {
    const auto at_corner = [&](Index k) { return number[static_cast<std::size_t>(origin(3 * f + k))]; };
    return static_cast<std::size_t>(std::min({at_corner(0), at_corner(1), at_corner(2)}));
  };
  std::vector<Index> start(vertices + 1, 0), order(static_cast<std::size_t>(live_faces_));
  for (Index f = 0; f < halfedge_count() / 3; ++f)
    if (alive(3 * f)) ++start[smallest(f) + 1];
  for (std::size_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  for (Index f = 0; f < halfedge_count() / 3; ++f)
    if (alive(3 * f)) order[static_cast<std::size_t>(start[smallest(f)]++)] = f;
  return order;
}

std::vector<Index> EditableMesh::pack() {
  std::vector<Index> vertices = breadth_first();
  std::vector<Index> number(outgoing_.size(), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    number[static_cast<std::size_t>(vertices[i])] = static_cast<Index>(i);
  const std::vector<Index> faces = faces_by_vertex(number, vertices.size());
  std::vector<Index> face_number(halves_.size() / 3, -1);
  for (std::size_t i = 0; i < faces.size(); ++i)
    face_number[static_cast<std::size_t>(faces[i])] = static_cast<Index>(i);

  const auto renumbered = [&](Index h) {
    return h < 0 ? -1 : 3 * face_number[static_cast<std::size_t>(h / 3)] + h % 3;
  };
  std::vector<Half> halves(3 * faces.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const Half& half = at(3 * faces[i / 3] + static_cast<Index>(i % 3));
    halves[i] = {number[static_cast<std::size_t>(half.origin)], renumbered(half.twin)};
  }
  std::vector<Index> outgoing, valence;
  outgoing.reserve(vertices.size());
  valence.reserve(vertices.size());
  for (Index v : vertices) {
    outgoing.push_back(renumbered(this->outgoing(v)));
    valence.push_back(this->valence(v));
  }
  halves_ = std::move(halves);
  outgoing_ = std::move(outgoing);
  valence_ = std::move(valence);
  return vertices;
}

std::vector<Triangle> EditableMesh::triangles() const {
  std::vector<Triangle> triangles(halves_.size() / 3);
  for (std::size_t h = 0; h < halves_.size(); ++h) triangles[h / 3][h % 3] = halves_[h].origin;
  return triangles;
}

}  // namespace pelage
