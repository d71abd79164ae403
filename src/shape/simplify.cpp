#include "shape/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

#include "base/box.h"
#include "base/srgb.h"
#include "shape/split_corners.h"
#include "shape/topology.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

constexpr std::size_t dimensions = 6;  // x y z r g b
using Place = std::array<double, dimensions>;

/// How far in parts of the diagonal a shift is as bad as the step from black to white.
constexpr double color_weight = 0.1;
/// Of a plane through an edge of the border against the faces there.
constexpr double border_weight = 10;
/// Of the square of an edge beside the quadrics.
constexpr double evenness = 1e-10;
/// Faces turn less than about 75 degrees at a time.
constexpr double least_cosine = 0.25;
/// Twice the area of a face over the square of its longest edge: below this it is a needle.
constexpr double least_shape = 0.02;

double inner(const Place& a, const Place& b) {
  double sum = 0;
  for (std::size_t i = 0; i < dimensions; ++i) sum += a[i] * b[i];
  return sum;
}

Place minus(const Place& a, const Place& b) {
  Place d;
  for (std::size_t i = 0; i < dimensions; ++i) d[i] = a[i] - b[i];
  return d;
}

Place scaled(const Place& a, double factor) {
  Place s = a;
  for (double& x : s) x *= factor;
  return s;
}

/// Sum of squared distances to planes: x A x + 2 b x + c with a symmetric A, its upper half row by row.
class Quadric {
 public:
  void add(const Quadric& other) {
    for (std::size_t i = 0; i < a_.size(); ++i) a_[i] += other.a_[i];
    for (std::size_t i = 0; i < dimensions; ++i) b_[i] += other.b_[i];
    c_ += other.c_;
  }
  /// The square of the distance to p + span(e, f), these orthonormal or zero, times `weight`.
  void add_flat(const Place& p, const Place& e, const Place& f, double weight) {
    const double pe = inner(p, e), pf = inner(p, f);
    std::size_t k = 0;
    for (std::size_t i = 0; i < dimensions; ++i) {
      for (std::size_t j = i; j < dimensions; ++j) a_[k++] += weight * ((i == j ? 1 : 0) - e[i] * e[j] - f[i] * f[j]);
      b_[i] += weight * (pe * e[i] + pf * f[i] - p[i]);
    }
    c_ += weight * (inner(p, p) - pe * pe - pf * pf);
  }
  /// The square of the distance to the plane through p with the unit normal n in space.
  void add_plane(const Place& p, const Place& n, double weight) {
    const double d = inner(p, n);
    std::size_t k = 0;
    for (std::size_t i = 0; i < dimensions; ++i) {
      for (std::size_t j = i; j < dimensions; ++j) a_[k++] += weight * n[i] * n[j];
      b_[i] -= weight * d * n[i];
    }
    c_ += weight * d * d;
  }
  double at(const Place& x) const {
    double sum = c_;
    std::size_t k = 0;
    for (std::size_t i = 0; i < dimensions; ++i) {
      double row = a_[k++] * x[i] + 2 * b_[i];
      for (std::size_t j = i + 1; j < dimensions; ++j) row += 2 * a_[k++] * x[j];
      sum += row * x[i];
    }
    return std::max(0.0, sum);
  }

 private:
  std::array<double, dimensions*(dimensions + 1) / 2> a_{};
  std::array<double, dimensions> b_{};
  double c_ = 0;
};

/// Vertices in space and encoded colour, in a box of diagonal 1.
std::vector<Place> places_of(const TriangleMesh& mesh) {
  const Box box = box_of(mesh.points);
  const double scale = box.diagonal() > 0 ? 1 / box.diagonal() : 1;
  const Point middle = box.middle();
  const Attribute* color = mesh.find("color");
  const bool colored = color && color->domain == Domain::vertex && color->components >= 3;
  std::vector<Place> places(mesh.points.size());
  for (std::size_t v = 0; v < places.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      places[v][k] = scale * (mesh.points[v][k] - middle[k]);
      if (colored)
        places[v][3 + k] =
            color_weight * srgb_from_linear(color->values[static_cast<std::size_t>(color->components) * v + k]);
    }
  return places;
}

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

class Simplifier {
 public:
  explicit Simplifier(const TriangleMesh& mesh)
      : faces_(mesh.triangles),
        wedges_(split_corners(mesh).triangles),
        place_(places_of(mesh)),
        faces_at_(mesh.points.size()),
        kept_(mesh.points.size()),
        border_(mesh.points.size()),
        stamp_(mesh.points.size()),
        best_(mesh.points.size()),
        quadric_(mesh.points.size()),
        own_(mesh.points.size()),
        left_(mesh.triangles.size()) {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (const Index v : faces_[f]) faces_at_[at(v)].push_back(static_cast<Index>(f));
    find_kept(mesh);
    find_quadrics();
  }

  void run(std::size_t target) {
    for (std::size_t v = 0; v < place_.size(); ++v) propose(static_cast<Index>(v));
    while (left_ > target && !queue_.empty()) {
      const Candidate best = queue_.top();
      queue_.pop();
      if (best.stamp != stamp_[at(best.from)] || faces_at_[at(best.from)].empty()) continue;
      if (allowed(best.from, best.to))
        collapse(best.from, best.to);
      else
        propose_allowed(best.from);
    }
  }

  bool is_left(std::size_t face) const { return faces_[face][0] >= 0; }
  const Triangle& face(std::size_t f) const { return faces_[f]; }
  /// Numbers of the vertices in the mesh whose corners are split.
  const Triangle& wedges(std::size_t f) const { return wedges_[f]; }

 private:
  struct Candidate {
    double cost;
    Index from, to;
    std::uint32_t stamp;
    bool operator<(const Candidate& other) const {
      return std::tie(other.cost, other.from) < std::tie(cost, from);  // the least is on top
    }
  };

  static std::size_t corner_of(const Triangle& t, Index v) { return t[0] == v ? 0 : t[1] == v ? 1 : 2; }

  /// Neighbours, each once for every face with that edge, so that those on the border come up once.
  void neighbours(Index v, std::vector<Index>& ring) const {
    ring.clear();
    for (const Index f : faces_at_[at(v)])
      for (const Index w : faces_[at(f)])
        if (w != v) ring.push_back(w);
    std::ranges::sort(ring);
  }

  void find_kept(const TriangleMesh& mesh) {
    std::vector<Index> ring;
    for (std::size_t v = 0; v < place_.size(); ++v) {
      neighbours(static_cast<Index>(v), ring);
      std::size_t ends = 0;
      for (auto first = ring.begin(); first != ring.end();) {
        const auto last = std::find_if(first, ring.end(), [&](Index w) { return w != *first; });
        if (last - first == 1) ++ends;
        if (last - first > 2) kept_[v] = true;
        first = last;
      }
      border_[v] = ends > 0;
      if (ends > 2 || differs(mesh, static_cast<Index>(v))) kept_[v] = true;
    }
  }

  /// Whether something at its corners or faces differs.
  bool differs(const TriangleMesh& mesh, Index v) const {
    const std::vector<Index>& faces = faces_at_[at(v)];
    for (const Index f : faces) {
      if (wedge(f, v) != wedge(faces[0], v)) return true;
      for (const Attribute& a : mesh.attributes) {
        if (a.domain != Domain::face) continue;
        const auto n = static_cast<std::ptrdiff_t>(a.components);
        if (!std::equal(a.values.begin() + f * n, a.values.begin() + (f + 1) * n, a.values.begin() + faces[0] * n))
          return true;
      }
    }
    return false;
  }

  Index wedge(Index f, Index v) const { return wedges_[at(f)][corner_of(faces_[at(f)], v)]; }

  void find_quadrics() {
    std::vector<Index> ring;
    for (const Triangle& t : faces_) add_face(t);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) add_border(faces_[f], k);
    for (std::size_t v = 0; v < place_.size(); ++v) own_[v] = quadric_[v].at(place_[v]);
  }

  void add_face(const Triangle& t) {
    const Place &p = place_[at(t[0])], d = minus(place_[at(t[1])], p), g = minus(place_[at(t[2])], p);
    const double l = std::sqrt(inner(d, d));
    const Place e = l > 0 ? scaled(d, 1 / l) : Place{};
    const Place h = minus(g, scaled(e, inner(g, e)));
    const double height = std::sqrt(inner(h, h));
    const Place f = height > 0 ? scaled(h, 1 / height) : Place{};
    for (const Index v : t) quadric_[at(v)].add_flat(p, e, f, l * height / 6);
  }

  Point space(Index v) const { return {place_[at(v)][0], place_[at(v)][1], place_[at(v)][2]}; }

  std::size_t faces_with(Index v, Index w) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(faces_at_[at(v)], [&](Index f) { return std::ranges::count(faces_[at(f)], w) > 0; }));
  }

  /// Where nothing follows beyond edge k, the edge holds its vertices.
  void add_border(const Triangle& t, std::size_t k) {
    const Index a = t[k], b = t[(k + 1) % 3];
    if (!border_[at(a)] || !border_[at(b)] || faces_with(a, b) != 1) return;
    const Point edge = difference(space(b), space(a));
    const Point n = unit(cross(edge, cross(edge, difference(space(t[(k + 2) % 3]), space(a)))));
    for (const Index v : {a, b})
      quadric_[at(v)].add_plane(place_[at(a)], {n[0], n[1], n[2], 0, 0, 0}, border_weight * dot(edge, edge));
  }

  /// Of each collapse of that vertex its cost.
  void find_targets(Index v) {
    neighbours(v, ring_);
    ring_.erase(std::unique(ring_.begin(), ring_.end()), ring_.end());
    targets_.clear();
    for (const Index w : ring_) targets_.emplace_back(cost(v, w), w);
  }

  /// Where nothing changes, short edges go first: faces stay even.
  double cost(Index from, Index to) const {
    const Point d = difference(space(to), space(from));
    return quadric_[at(from)].at(place_[at(to)]) + own_[at(to)] + evenness * dot(d, d);
  }

  void queue(Index v, double cost, Index target) {
    best_[at(v)] = {cost, target};
    queue_.push({cost, v, target, ++stamp_[at(v)]});
  }

  /// Puts the best collapse of that vertex in line; whether it is allowed is found when its turn comes.
  void propose(Index v) {
    if (kept_[at(v)]) return;
    find_targets(v);
    if (targets_.empty()) return;
    const auto& [cost, w] = *std::ranges::min_element(targets_);
    queue(v, cost, w);
  }

  /// The best one that is allowed now, if there is one.
  void propose_allowed(Index v) {
    find_targets(v);
    std::ranges::sort(targets_);
    const std::vector<std::pair<double, Index>> targets = targets_;
    ++stamp_[at(v)];
    best_[at(v)] = {0, -1};  // until something around it changes
    for (const auto& [cost, w] : targets)
      if (allowed(v, w)) return queue(v, cost, w);
  }

  /// `v` is beside `to`, onto which `from` has gone: the other collapses of v cost what they did.
  void follow(Index v, Index from, Index to) {
    const auto& [least, target] = best_[at(v)];
    if (kept_[at(v)]) return;
    if (target == from || target == to || target < 0) return propose(v);
    if (const double now = cost(v, to); now < least) queue(v, now, to);
  }

  bool allowed(Index from, Index to) {
    const std::size_t shared = faces_with(from, to);
    if (border_[at(from)] ? shared != 1 : shared != 2) return false;
    return keeps_topology(from, to, shared) && keeps_corners(from, to) && keeps_sides(from, to);
  }

  /// The link condition: the ends of the edge have no neighbours in common but those of its faces.
  bool keeps_topology(Index from, Index to, std::size_t shared) {
    neighbours(from, ends_[0]);
    neighbours(to, ends_[1]);
    for (auto& ring : ends_) ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    common_.clear();
    std::ranges::set_intersection(ends_[0], ends_[1], std::back_inserter(common_));
    const bool closes = ends_[0].size() == 3 && ends_[1].size() == 3 && !border_[at(from)];  // a tetrahedron
    return common_.size() == shared && !closes;
  }

  /// The faces that go agree on what is at the vertex that stays.
  bool keeps_corners(Index from, Index to) const {
    Index found = -1;
    for (const Index f : faces_at_[at(from)]) {
      if (std::ranges::count(faces_[at(f)], to) == 0) continue;
      const Index here = wedge(f, to);
      if (found >= 0 && here != found) return false;
      found = here;
    }
    return true;
  }

  bool keeps_sides(Index from, Index to) const {
    for (const Index f : faces_at_[at(from)]) {
      Triangle t = faces_[at(f)];
      if (std::ranges::count(t, to) > 0) continue;
      const Point before = normal(t);
      t[corner_of(t, from)] = to;
      const Point after = normal(t);
      const double size = length(after);
      if (dot(before, after) < least_cosine * length(before) * size || size < least_shape * longest(t)) return false;
    }
    return true;
  }

  Point normal(const Triangle& t) const {
    return cross(difference(space(t[1]), space(t[0])), difference(space(t[2]), space(t[0])));
  }

  /// The square of the longest edge.
  double longest(const Triangle& t) const {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point e = difference(space(t[(k + 1) % 3]), space(t[k]));
      most = std::max(most, dot(e, e));
    }
    return most;
  }

  void collapse(Index from, Index to) {
    Index corner = -1;
    for (const Index f : faces_at_[at(from)])
      if (std::ranges::count(faces_[at(f)], to) > 0) corner = wedge(f, to);
    for (const Index f : faces_at_[at(from)]) {
      Triangle& t = faces_[at(f)];
      if (std::ranges::count(t, to) > 0) {
        remove(f, from);
        continue;
      }
      const std::size_t k = corner_of(t, from);
      t[k] = to;
      wedges_[at(f)][k] = corner;
      faces_at_[at(to)].push_back(f);
    }
    faces_at_[at(from)] = {};
    quadric_[at(to)].add(quadric_[at(from)]);
    own_[at(to)] = quadric_[at(to)].at(place_[at(to)]);
    std::vector<Index> around;
    neighbours(to, around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    propose(to);
    for (const Index v : around) follow(v, from, to);
  }

  void remove(Index f, Index from) {
    for (const Index v : faces_[at(f)])
      if (v != from) std::erase(faces_at_[at(v)], f);
    faces_[at(f)] = {-1, -1, -1};
    --left_;
  }

  std::vector<Triangle> faces_, wedges_;
  std::vector<Place> place_;
  std::vector<std::vector<Index>> faces_at_;
  std::vector<char> kept_, border_;
  std::vector<std::uint32_t> stamp_;
  std::vector<std::pair<double, Index>> best_;  ///< what of each vertex is in line: cost and target
  std::vector<Quadric> quadric_;
  std::vector<double> own_;  ///< of the quadric at its vertex
  std::size_t left_;
  std::priority_queue<Candidate> queue_;
  std::vector<Index> ring_, common_;  ///< working space
  std::array<std::vector<Index>, 2> ends_;
  std::vector<std::pair<double, Index>> targets_;
};

/// Tuples of that attribute, one for each number.
Attribute picked(const Attribute& a, const std::vector<std::size_t>& numbers) {
  Attribute result = a;
  const auto n = static_cast<std::size_t>(a.components);
  result.values.clear();
  result.values.reserve(n * numbers.size());
  for (const std::size_t i : numbers)
    for (std::size_t k = 0; k < n; ++k) result.values.push_back(a.values[n * i + k]);
  return result;
}

/// Of every vertex of the mesh whose corners are split a corner where it is.
std::vector<std::size_t> corner_of_wedge(const std::vector<Triangle>& wedges) {
  std::vector<std::size_t> corner;
  for (std::size_t f = 0; f < wedges.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t w = at(wedges[f][k]);
      if (w >= corner.size()) corner.resize(w + 1);
      corner[w] = 3 * f + k;
    }
  return corner;
}

TriangleMesh what_is_left(const TriangleMesh& mesh, const Simplifier& s) {
  const std::vector<std::size_t> corner = corner_of_wedge(split_corners(mesh).triangles);
  TriangleMesh result;
  result.links = mesh.links;
  result.metres_per_unit = mesh.metres_per_unit;
  std::vector<Index> number(mesh.points.size(), -1);
  std::vector<std::size_t> vertices, corners, faces;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!s.is_left(f)) continue;
    faces.push_back(f);
    Triangle t = s.face(f);
    for (std::size_t k = 0; k < 3; ++k) {
      corners.push_back(corner[at(s.wedges(f)[k])]);
      Index& n = number[at(t[k])];
      if (n < 0) {
        n = static_cast<Index>(vertices.size());
        vertices.push_back(at(t[k]));
      }
      t[k] = n;
    }
    result.triangles.push_back(t);
  }
  for (const std::size_t v : vertices) result.points.push_back(mesh.points[v]);
  for (const Attribute& a : mesh.attributes)
    result.attributes.push_back(picked(a, a.domain == Domain::vertex   ? vertices
                                          : a.domain == Domain::corner ? corners
                                                                       : faces));
  return result;
}

}  // namespace

TriangleMesh simplify(const TriangleMesh& mesh, std::size_t triangles) {
  if (mesh.triangles.size() <= triangles) return mesh;
  Simplifier s(mesh);
  s.run(triangles);
  return what_is_left(mesh, s);
}

}  // namespace pelage
