#include "shape/locate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "shape/normals.h"

namespace pelage {

namespace {

using Vec = Eigen::Vector3d;

double fraction(double numerator, double denominator) {
  return denominator > 0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0;
}

}  // namespace

SurfaceWalk::SurfaceWalk(const Topology& topology, const std::vector<Point>& points) {
  faces_.resize(topology.triangles.size());
  for (std::size_t f = 0; f < faces_.size(); ++f)
    faces_[f] = {topology.triangles[f], {topology.twin[3 * f], topology.twin[3 * f + 1], topology.twin[3 * f + 2]}};
  points_.reserve(points.size());
  for (const Point& p : points) points_.emplace_back(p.data());
}

SurfaceWalk::SurfaceWalk(const std::vector<Triangle>& triangles, const std::vector<Point>& points) {
  faces_.reserve(triangles.size());
  for (const Triangle& t : triangles) faces_.push_back({t, {-1, -1, -1}});
  points_.reserve(points.size());
  for (const Point& p : points) points_.emplace_back(p.data());
}

SurfaceWalk::~SurfaceWalk() = default;

Vec SurfaceWalk::normal(Index face) const {
  const Triangle& t = faces_[static_cast<std::size_t>(face)].corners;
  return (point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0]));
}

/// Minimum over the triangle of |p - a - v ab - w ac|^2: inside, or on one of the edges.
SurfaceWalk::Candidate SurfaceWalk::nearest_on(Index face, const Vec& p) const {
  const Triangle& t = faces_[static_cast<std::size_t>(face)].corners;
  const Vec &a = point(t[0]), ab = point(t[1]) - a, ac = point(t[2]) - a, d = p - a;
  const double bb = ab.squaredNorm(), bc = ab.dot(ac), cc = ac.squaredNorm();
  const double db = ab.dot(d), dc = ac.dot(d), det = bb * cc - bc * bc;
  const auto place = [&](double v, double w) { return Candidate{{face, v, w}, (d - v * ab - w * ac).squaredNorm()}; };
  const double v = cc * db - bc * dc, w = bb * dc - bc * db;
  if (v >= 0 && w >= 0 && v + w <= det && det > 0) return place(v / det, w / det);
  const double s = fraction(dc - db + bb - bc, bb - 2 * bc + cc);
  Candidate best = place(fraction(db, bb), 0);
  for (const Candidate& edge : {place(0, fraction(dc, cc)), place(1 - s, s)})
    if (edge.square < best.square) best = edge;
  return best;
}

/// The best of `best` and the triangles around the origin of a half-edge.
SurfaceWalk::Candidate SurfaceWalk::nearest_around(Index corner, const Vec& p, Candidate best) const {
  const auto twin = [&](Index h) {
    return faces_[static_cast<std::size_t>(h / 3)].twin[static_cast<std::size_t>(h % 3)];
  };
  const auto look = [&](Index h) {
    const Candidate there = nearest_on(h / 3, p);
    if (there.square < best.square) best = there;
  };
  Index h = corner;
  for (h = twin(previous_halfedge(h)); h >= 0 && h != corner; h = twin(previous_halfedge(h))) look(h);
  if (h < 0)  // an open fan: the other way round
    for (h = twin(corner); h >= 0; h = twin(h)) look(h = next_halfedge(h));
  return best;
}

/// Over the edge or vertex on which a candidate lies, if that is nearer.
SurfaceWalk::Candidate SurfaceWalk::nearest_beyond(const Candidate& from, const Vec& p) const {
  const auto& [face, v, w] = from.place;
  const double u = 1 - v - w;
  if (w == 0 && (v == 0 || v == 1)) return nearest_around(3 * face + (v == 1), p, from);
  if (w == 1) return nearest_around(3 * face + 2, p, from);
  const std::size_t side = w == 0 ? 0 : v == 0 ? 2 : 1;
  if (side == 1 && u > 1e-12) return from;  // inside
  const Index twin = faces_[static_cast<std::size_t>(face)].twin[side];
  if (twin < 0) return from;
  const Candidate there = nearest_on(twin / 3, p);
  return there.square < from.square ? there : from;
}

MeshPlace SurfaceWalk::closest(const Vec& p, Index from_face) const {
  for (Candidate here = nearest_on(from_face, p);;) {
    const Candidate next = nearest_beyond(here, p);
    if (!(next.square < here.square)) return here.place;
    here = next;
  }
}

SurfaceWalk::Candidate SurfaceWalk::better(Index face, const Vec& p, const Vec& along, const Candidate& best) const {
  if (!along.isZero(0) && normal(face).dot(along) <= 0) return best;
  const Candidate there = nearest_on(face, p);
  return there.square < best.square || (there.square == best.square && face < best.place.face) ? there : best;
}

MeshPlace SurfaceWalk::compare_all(const Vec& p, const Vec& along) const {
  std::vector<Candidate> parts(chunk_count(faces_.size()));
  parallel_for(faces_.size(), [&](std::size_t begin, std::size_t end) {
    Candidate& best = parts[begin / default_chunk];
    for (std::size_t f = begin; f < end; ++f) best = better(static_cast<Index>(f), p, along, best);
  });
  Candidate best;
  for (const Candidate& part : parts)
    if (part.square < best.square) best = part;
  return best.place.face >= 0 || along.isZero(0) ? best.place : compare_all(p, Vec::Zero());
}

/// Boxes around halves of the triangles.
class SurfaceWalk::Tree {
 public:
  explicit Tree(const SurfaceWalk& surface) : surface_(surface), faces_(surface.face_count()), middles_(faces_.size()) {
    std::iota(faces_.begin(), faces_.end(), 0);
    for (std::size_t f = 0; f < faces_.size(); ++f) middles_[f] = corners(f).rowwise().mean();
    build(0, faces_.size());
  }

  /// The nearest triangle that faces along the normal; of equally near ones the first. Face -1 if there is none.
  MeshPlace nearest(const Vec& p, const Vec& normal, Index near) const {
    Candidate best;
    if (near >= 0) best = surface_.better(near, p, normal, best);
    visit(0, p, normal, best);
    return best.place;
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t begin, end, right;  ///< triangles, and the node of the second half (0 in a leaf)
  };
  static constexpr std::size_t leaf_size = 6;  // triangles; about as fast as one more level

  Eigen::Matrix3d corners(std::size_t f) const {
    const Triangle& t = surface_.faces_[f].corners;
    Eigen::Matrix3d result;
    result << surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2]);
    return result;
  }

  void build(std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    Eigen::AlignedBox3d box, middles;
    for (std::size_t i = begin; i < end; ++i) {
      const auto f = static_cast<std::size_t>(faces_[i]);
      for (int k = 0; k < 3; ++k) box.extend(Vec(corners(f).col(k)));
      middles.extend(middles_[f]);
    }
    nodes_.push_back({box, begin, end, 0});
    if (end - begin <= leaf_size) return;
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::size_t half = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return faces_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(half), at(end), [&](Index f, Index g) {
      return middles_[static_cast<std::size_t>(f)][axis] < middles_[static_cast<std::size_t>(g)][axis];
    });
    build(begin, half);
    nodes_[number].right = nodes_.size();
    build(half, end);
  }

  void visit(std::size_t number, const Vec& p, const Vec& normal, Candidate& best) const {
    const Node& node = nodes_[number];
    if (node.box.squaredExteriorDistance(p) > best.square) return;
    if (node.right > 0) {
      const auto distance = [&](std::size_t n) { return nodes_[n].box.squaredExteriorDistance(p); };
      const bool swap = distance(node.right) < distance(number + 1);
      visit(swap ? node.right : number + 1, p, normal, best);
      visit(swap ? number + 1 : node.right, p, normal, best);
      return;
    }
    for (std::size_t i = node.begin; i < node.end; ++i) best = surface_.better(faces_[i], p, normal, best);
  }

  const SurfaceWalk& surface_;
  std::vector<Index> faces_;
  std::vector<Vec> middles_;
  std::vector<Node> nodes_;
};

MeshPlace SurfaceWalk::search(const Vec& p, const Vec& normal, Index near) const {
  if (faces_.empty()) return {};
  std::call_once(tree_built_, [&] { tree_ = std::make_unique<Tree>(*this); });
  const MeshPlace facing = tree_->nearest(p, normal, near);
  return facing.face >= 0 ? facing : tree_->nearest(p, Vec::Zero(), near);
}

namespace {

/// The vertices of a mesh are located in rings around a first one of each component.
class Locating {
 public:
  Locating(const Topology& topology, const std::vector<Point>& points, const SurfaceWalk& surface)
      : topology_(topology),
        points_(points),
        normals_(vertex_normals(topology.triangles, points)),
        surface_(surface),
        parent_(points.size(), none),
        places_(points.size()) {}

  std::vector<MeshPlace> run() {
    for (Index v = 0; v < topology_.vertex_count; ++v)
      if (topology_.outgoing[static_cast<std::size_t>(v)] >= 0 && parent_[static_cast<std::size_t>(v)] == none)
        spread(v);
    return std::move(places_);
  }

 private:
  static constexpr Index none = -1;
  Vec point(Index v) const { return Vec(points_[static_cast<std::size_t>(v)].data()); }
  Vec normal(Index v) const { return Vec(normals_[static_cast<std::size_t>(v)].data()); }

  void spread(Index seed) {
    const bool tree = ++components_ > 8;  // before, the tree would not pay
    places_[static_cast<std::size_t>(seed)] =
        tree ? surface_.search(point(seed), normal(seed)) : surface_.compare_all(point(seed), normal(seed));
    parent_[static_cast<std::size_t>(seed)] = seed;
    std::vector<Index> ring = {seed};
    while (!ring.empty()) {
      ring = next_ring(ring);
      parallel_for(
          ring.size(),
          [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) places_[static_cast<std::size_t>(ring[i])] = find(ring[i]);
          },
          256);  // a walk takes a tenth of a microsecond
    }
  }

  std::vector<Index> next_ring(const std::vector<Index>& ring) {
    std::vector<Index> next;
    for (Index v : ring) {
      const auto meet = [&](Index n) {
        Index& parent = parent_[static_cast<std::size_t>(n)];
        if (parent != none) return;
        parent = v;
        next.push_back(n);
      };
      const Index start = topology_.outgoing[static_cast<std::size_t>(v)];
      for (Index h = start; h >= 0;) {
        meet(topology_.target(h));
        const Index following = topology_.rotate(h);
        if (following < 0) meet(topology_.origin(previous_halfedge(h)));
        h = following == start ? -1 : following;
      }
    }
    return next;
  }

  MeshPlace find(Index v) const {
    const Index parent = parent_[static_cast<std::size_t>(v)];
    const Vec p = point(v);
    const MeshPlace walked = surface_.closest(p, places_[static_cast<std::size_t>(parent)].face);
    const double distance = (surface_.point(walked) - p).norm();
    const Vec facing = surface_.normal(walked.face);
    const bool away = facing.dot(normal(v)) < 0;
    // Triangulations of one surface differ by the bend of an edge of either, which is much less than its half.
    const double edge = std::max((p - point(parent)).norm(), std::sqrt(facing.norm()));
    if (!away && distance <= 0.5 * edge) return walked;
    const MeshPlace found = surface_.search(p, normal(v));
    return away || (surface_.point(found) - p).norm() < distance ? found : walked;
  }

  const Topology& topology_;
  const std::vector<Point>& points_;
  std::vector<Point> normals_;
  const SurfaceWalk& surface_;
  std::vector<Index> parent_;
  std::vector<MeshPlace> places_;
  int components_ = 0;
};

}  // namespace

std::vector<MeshPlace> locate(const Topology& topology, const std::vector<Point>& points, const SurfaceWalk& surface) {
  if (surface.face_count() == 0) return std::vector<MeshPlace>(points.size());
  return Locating(topology, points, surface).run();
}

}  // namespace pelage
