#pragma once
// Connectivity of an oriented manifold triangle mesh that changes edge by edge, in place.
//
// Half-edges are numbered as in topology.h: 3 f + k runs from corner k of triangle f to the next. Cuts append triangles
// and vertices; what a collapse removes keeps its number and is dead until the mesh is packed.

#include <vector>

#include "shape/topology.h"

namespace pelage {

class EditableMesh {
 public:
  explicit EditableMesh(const Topology& topology);

  Index vertex_count() const { return static_cast<Index>(outgoing_.size()); }  ///< dead ones included
  Index halfedge_count() const { return static_cast<Index>(halves_.size()); }  ///< dead ones included
  Index live_vertices() const { return live_vertices_; }
  Index live_faces() const { return live_faces_; }
  bool alive(Index halfedge) const { return at(halfedge).origin >= 0; }
  bool vertex_alive(Index v) const { return outgoing(v) >= 0; }

  Index origin(Index h) const { return at(h).origin; }
  Index target(Index h) const { return origin(next_halfedge(h)); }
  Index twin(Index h) const { return at(h).twin; }  ///< -1 on the boundary
  /// Of a half-edge on a crease: the number of the line, from 1 on, negative against its direction; else 0. Cuts and
  /// collapses take it along; edges of lines are not turned.
  Index line(Index h) const { return lines_.empty() ? 0 : lines_[static_cast<std::size_t>(h)]; }
  /// Marks a half-edge and its twin.
  void set_line(Index h, Index line);
  /// As in Topology: on the boundary the first one counter-clockwise; -1 for dead vertices.
  Index outgoing(Index v) const { return outgoing_[static_cast<std::size_t>(v)]; }
  Index valence(Index v) const { return valence_[static_cast<std::size_t>(v)]; }  ///< number of edges
  bool on_boundary(Index v) const { return twin(outgoing(v)) < 0; }
  bool adjacent(Index a, Index b) const;

  /// Calls visit(neighbour) counter-clockwise; on the boundary from the first to the last boundary neighbour.
  template <class Visit>
  void around(Index v, Visit&& visit) const {
    const Index start = outgoing(v);
    for (Index h = start; h >= 0;) {
      visit(target(h));
      const Index last = previous_halfedge(h), following = twin(last);
      if (following < 0) visit(origin(last));
      h = following == start ? -1 : following;
    }
  }

  /// Makes room for cuts.
  void reserve(std::size_t vertices) {
    outgoing_.reserve(vertices);
    valence_.reserve(vertices);
    halves_.reserve(6 * vertices);
  }
  /// Cuts an edge with a new vertex, whose number is returned; all new edges belong to a new triangle.
  Index split(Index h);
  /// Is the mesh a manifold without doubled edges after the edge has been turned?
  bool may_flip(Index h) const;
  /// Turns edge ab between triangles abc and bad into dc; h then runs from d to c.
  void flip(Index h);
  /// Does the surface keep its form (manifold, genus, boundaries) when the edge shrinks to a point?
  bool may_collapse(Index h) const;
  /// The target of h merges into its origin. Edges across become one, two triangles (or one on the boundary) die.
  void collapse(Index h);

  /// Numbers live vertices and triangles anew: breadth first, triangles in the order of their smallest vertex. Returns
  /// the old number of each new vertex.
  std::vector<Index> pack();
  Topology topology() const;  ///< of a packed mesh

 private:
  struct Half {
    Index origin, twin;
  };
  const Half& at(Index h) const { return halves_[static_cast<std::size_t>(h)]; }
  Half& at(Index h) { return halves_[static_cast<std::size_t>(h)]; }
  Index& outgoing_of(Index v) { return outgoing_[static_cast<std::size_t>(v)]; }
  Index& valence_of(Index v) { return valence_[static_cast<std::size_t>(v)]; }
  void join(Index a, Index b);
  Index add_face(Index a, Index b, Index c);
  Index split_side(Index h, Index middle);
  Index remove_face(Index h);
  std::vector<Index> breadth_first() const;
  std::vector<Index> faces_by_vertex(const std::vector<Index>& order, const std::vector<Index>& number) const;

  void take_line(Index to, Index from);

  std::vector<Half> halves_;
  std::vector<Index> lines_;  ///< per half-edge; empty without lines
  std::vector<Index> outgoing_, valence_;
  Index live_vertices_ = 0, live_faces_ = 0;
};

}  // namespace pelage
