#include "shape/isotropic_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/report.h"
#include "pelage/error.h"
#include "shape/crease_lines.h"
#include "shape/creases.h"
#include "shape/editable_mesh.h"
#include "shape/locate.h"
#include "shape/own_order.h"

namespace pelage {

namespace {

using Vec = Eigen::Vector3d;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The boundary of the base as lines; a place on them is a half-edge without twin and a fraction of it.
class BorderLines {
 public:
  struct Place {
    Index halfedge;
    double along;
  };

  BorderLines(const Topology& topology, const std::vector<Point>& points)
      : topology_(topology), points_(points), incoming_(points.size(), -1) {
    for (std::size_t h = 0; h < topology.twin.size(); ++h)
      if (topology.twin[h] < 0) incoming_[at(topology.target(static_cast<Index>(h)))] = static_cast<Index>(h);
  }

  /// So far along the line, backwards for negative lengths.
  Place advance(Place from, double length) const {
    for (length += from.along * length_of(from.halfedge); length < 0; length += length_of(from.halfedge))
      from.halfedge = previous(from.halfedge);
    for (; length >= length_of(from.halfedge); from.halfedge = next(from.halfedge)) length -= length_of(from.halfedge);
    return {from.halfedge, length / length_of(from.halfedge)};
  }
  /// Half way along the line from one place to another.
  Place middle(const Place& from, const Place& to) const {
    double length = to.along * length_of(to.halfedge) - from.along * length_of(from.halfedge);
    Index h = from.halfedge;
    if (h == to.halfedge && to.along < from.along) length += length_of(h), h = next(h);
    for (; h != to.halfedge; h = next(h)) length += length_of(h);
    return advance(from, length / 2);
  }
  Vec point(const Place& place) const {
    return (1 - place.along) * begin(place.halfedge) + place.along * end(place.halfedge);
  }
  /// Does the line turn by more than 40 degrees where a half-edge begins?
  bool corner(Index halfedge) const {
    const Vec in = end(previous(halfedge)) - begin(previous(halfedge)), out = end(halfedge) - begin(halfedge);
    constexpr double cosine = 0.766;  // of 40 degrees
    return in.dot(out) < cosine * in.norm() * out.norm();
  }

 private:
  Vec begin(Index h) const { return Vec(points_[at(topology_.origin(h))].data()); }
  Vec end(Index h) const { return Vec(points_[at(topology_.target(h))].data()); }
  Index next(Index h) const { return topology_.outgoing[at(topology_.target(h))]; }
  Index previous(Index h) const { return incoming_[at(topology_.origin(h))]; }
  /// Never 0, so that every walk moves on.
  double length_of(Index h) const { return std::max((end(h) - begin(h)).norm(), std::numeric_limits<double>::min()); }

  const Topology& topology_;
  const std::vector<Point>& points_;
  std::vector<Index> incoming_;  ///< per vertex: the half-edge of the boundary that ends there
};

/// Lowers values so that they grow by at most `slope` times the length of an edge.
void limit_slope(const Topology& topology, const std::vector<Point>& points, double slope,
                 std::vector<double>& values) {
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::size_t v = 0; v < values.size(); ++v) open.push({values[v], static_cast<Index>(v)});
  std::vector<Index> ring;
  while (!open.empty()) {
    const auto [value, v] = open.top();
    open.pop();
    if (value > values[at(v)]) continue;
    topology.one_ring(v, ring);
    for (Index n : ring) {
      const double most = value + slope * (Vec(points[at(n)].data()) - Vec(points[at(v)].data())).norm();
      if (most < values[at(n)]) open.push({values[at(n)] = most, n});
    }
  }
}

/// Neighbours of all vertices, counter-clockwise, in one array.
struct Rings {
  std::vector<Index> first, neighbours;
  const Index* begin(std::size_t v) const { return neighbours.data() + first[v]; }
  const Index* end(std::size_t v) const { return begin(v + 1); }

  explicit Rings(const EditableMesh& mesh) : first(at(mesh.vertex_count()) + 1, 0) {
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      first[at(v) + 1] = first[at(v)] + (mesh.vertex_alive(v) ? mesh.valence(v) : 0);
    neighbours.resize(at(first.back()));
    parallel_for(at(mesh.vertex_count()), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        Index* fill = neighbours.data() + first[v];
        if (mesh.vertex_alive(static_cast<Index>(v))) mesh.around(static_cast<Index>(v), [&](Index n) { *fill++ = n; });
      }
    });
  }
};

/// A vertex that moves by less than this share of its wanted edge moves no others.
constexpr double at_rest = 0.02;

constexpr double most_faces = 1e8;  // numbers of half-edges stay below 2^31 while the mesh is refined

/// Is the area between two edges, their cross product, so small that rounding chose its direction?
bool flat(const Vec& cross, const Vec& a, const Vec& b) {
  constexpr double sine = 1e-4;
  return cross.squaredNorm() <= sine * sine * a.squaredNorm() * b.squaredNorm();
}

/// How freely a vertex moves; of two that merge the less free one stays.
/// Lines and points (their ends and corners) are those of the base's creases, creases what the mesh itself bends to.
enum class Hold : char { free, crease, line, border, point, corner };

/// On a crease of the base.
bool marked(Hold hold) { return hold == Hold::line || hold == Hold::point; }

signed char aim(Hold hold) { return hold == Hold::corner ? 3 : hold == Hold::border ? 4 : 6; }

struct alignas(64) Spot {  // one line of the cache
  Vec point;
  MeshPlace place;
  Index border = -1;  ///< on boundaries and lines: the half-edge of the base on which it lies
  Hold hold = Hold::free;
  double size = 0;  ///< wanted edge
};

bool crease_corner(const Topology& t, std::size_t vertex) { return t.creases.any() && t.creases.corner[vertex]; }

/// Equilateral triangles of edge h have the area sqrt(3) / 4 h^2.
double wanted_faces(const Topology& base, const std::vector<Point>& points, const std::vector<double>& sizes) {
  const auto point = [&](Index v) { return Vec(points[at(v)].data()); };
  const auto partial = [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t f = begin; f < end; ++f) {
      const Triangle& t = base.triangles[f];
      double density = 0;
      for (Index v : t) density += 1 / (3 * sizes[at(v)] * sizes[at(v)]);
      sum += (point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0])).norm() / 2 * density;
    }
    return sum;
  };
  return ordered_sum(base.triangles.size(), 0.0, partial) * 4 / std::sqrt(3.0);
}

class IsotropicMesher {
 public:
  IsotropicMesher(const Topology& base, const std::vector<Point>& points, std::vector<double> sizes,
                  const OwnOrder& start, const Progress& progress);
  /// To so many triangles; without the points.
  IsotropicMesh run(double wanted);

 private:
  double edge_square(Index h) const {
    return (spot(mesh_.origin(h)).point - spot(mesh_.target(h)).point).squaredNorm();
  }
  double wanted_edge(Index a, Index b) const { return scale_ * (spot(a).size + spot(b).size) / 2; }
  /// Is the edge longer than so many wanted ones?
  bool longer(Index h, double factor) const {
    const double limit = factor * wanted_edge(mesh_.origin(h), mesh_.target(h));
    return edge_square(h) > limit * limit;
  }
  double longest() const;
  /// The half-edges, one of each edge, for which a test holds.
  template <class Test>
  std::vector<Index> edges_where(Test&& test) const;

  void split_above(double factor);
  void cut(Index h);
  bool fans_out(Index h, const Vec& middle) const;
  Spot middle(Index h) const;
  bool on_rim(const MeshPlace& place) const;
  Spot on_surface(const Vec& p, Index from_face) const;
  Spot on_border(const BorderLines::Place& line) const;
  Spot on_crease(const CreaseLines::Place& line) const;
  static CreaseLines::Place on_crease_line(const Spot& spot) {
    return {spot.border, fraction_on(spot.border, spot.place)};
  }
  Spot middle_of_line(Index h) const;
  void mark_lines(const Topology& start, const std::vector<Index>& vertex);
  Index line_between(Index a, Index b, std::size_t vertices) const;
  Spot start_on_crease(Index vertex, Spot spot) const;
  bool crosses(Index face, Index v) const;
  bool leaves_region(Index h, const Spot& fresh) const;
  bool keeps_lines(Index h) const;
  static BorderLines::Place on_line(const Spot& spot) { return {spot.border, fraction_on(spot.border, spot.place)}; }

  void collapse_below(double factor, double longest);
  Spot merged(Index h) const;
  Vec meeting(Index h) const;
  bool reaches(Index v, const Vec& target, double longest) const;
  bool keeps_form(Index moved, Index other, const Vec& target) const;
  bool should_collapse(Index h, double longest) const;
  void drop_low_valences();

  void flip_all();
  /// Interior vertices keep 4 edges; on the boundary, two would make a flat triangle.
  bool may_lose_edge(Index v) const { return excess(v) >= (aims_[at(v)] == 6 ? -1 : 0); }
  /// Does turning an edge lower the sum of the squares of the excesses?
  bool flip_helps(Index h) const {
    return excess(mesh_.origin(h)) + excess(mesh_.target(h)) - excess(mesh_.origin(previous_halfedge(h))) -
               excess(mesh_.origin(previous_halfedge(mesh_.twin(h)))) >
           2;
  }
  /// Edges more than wanted.
  Index excess(Index v) const { return mesh_.valence(v) - aims_[at(v)]; }
  bool flip_keeps_form(Index h) const;

  void relax(int times);
  bool turns_over(const Vec& from, const Vec& to, const Index* begin, const Index* end) const;
  Spot relaxed(Index v, const Index* begin, const Index* end) const;
  Spot relaxed_on_line(Index v, const Index* begin, const Index* end) const;

  void pack();
  void ask() const { report(progress_, "meshing", done_); }
  /// Within a pass over all edges of a large mesh.
  void ask_now_and_then(Index edge) const {
    constexpr Index often = 1 << 16;
    if (edge % often == 0) ask();
  }
  Vec face_normal(Index a, Index b, Index c) const {
    return (spot(b).point - spot(a).point).cross(spot(c).point - spot(a).point);
  }
  const Spot& spot(Index v) const { return spots_[at(v)]; }
  Spot& spot(Index v) { return spots_[at(v)]; }

  const Topology& base_;
  const std::vector<Point>& points_;
  const Progress& progress_;
  double done_ = 0;  ///< of the rounds
  SurfaceWalk surface_;
  BorderLines border_;
  CreaseLines lines_;
  std::vector<Index> region_;  ///< per triangle of the base; empty without creases
  std::vector<double> sizes_;  ///< per base vertex
  bool even_;                  ///< are all sizes the same?
  EditableMesh mesh_;
  std::vector<Spot> spots_;
  std::vector<char> stirred_;      ///< per vertex: has it moved, or have its edges changed, since the last relaxation?
  std::vector<signed char> aims_;  ///< per vertex: its wanted valence
  double scale_ = 1;
};

IsotropicMesher::IsotropicMesher(const Topology& base, const std::vector<Point>& points, std::vector<double> sizes,
                                 const OwnOrder& start, const Progress& progress)
    : base_(base),
      points_(points),
      progress_(progress),
      surface_(base, points),
      border_(base, points),
      lines_(base, points),
      region_(base.creases.any() ? smooth_regions(base) : std::vector<Index>{}),
      sizes_(std::move(sizes)),
      even_(std::adjacent_find(sizes_.begin(), sizes_.end(), std::not_equal_to<>()) == sizes_.end()),
      mesh_(start.topology),
      spots_(start.vertex.size()),
      stirred_(spots_.size(), true),
      aims_(spots_.size(), aim(Hold::free)) {
  for (std::size_t v = 0; v < spots_.size(); ++v) {
    const std::size_t source = at(start.vertex[v]);
    const Index h = first_halfedge(base, points, start.vertex[v]);
    if (h < 0) continue;
    const bool border = base.twin[at(h)] < 0;
    spots_[v] = {Vec(points[source].data()), place_on(h, 0), border ? h : -1, Hold::free, sizes_[source]};
    if (border) spots_[v].hold = border_.corner(h) || crease_corner(base, source) ? Hold::corner : Hold::border;
    if (!border && base.creases.any()) spots_[v] = start_on_crease(start.vertex[v], spots_[v]);
    aims_[v] = aim(spots_[v].hold);
  }
  if (!lines_.empty()) mark_lines(start.topology, start.vertex);
}

/// A vertex of the base inside, as it is held on creases.
Spot IsotropicMesher::start_on_crease(Index vertex, Spot spot) const {
  VertexRing around;
  vertex_ring(base_, vertex, around);
  if (around.sharp.empty()) return spot;
  if (around.corner || around.sharp.size() != 2) {
    spot.hold = Hold::point;
    return spot;
  }
  Index h = base_.outgoing[at(vertex)];
  while (lines_.line(h) <= 0) h = base_.rotate(h);
  spot.hold = Hold::line;
  spot.border = h;
  spot.place = place_on(h, 0);
  return spot;
}

/// The line from one vertex of the base to another that is the first after it among the first `vertices`, with the
/// sign of the direction.
Index IsotropicMesher::line_between(Index a, Index b, std::size_t vertices) const {
  const Index start = base_.outgoing[at(a)];
  Index h = start;
  do {
    if (lines_.line(h) != 0) {
      Index last = h;
      while (at(base_.target(last)) >= vertices) last = lines_.next(last);
      if (base_.target(last) == b) return lines_.line(h);
    }
    h = base_.rotate(h);
  } while (h >= 0 && h != start);
  return 0;
}

/// Of a mesh whose vertices are these of the base: edges of creases belong to its lines.
void IsotropicMesher::mark_lines(const Topology& start, const std::vector<Index>& vertex) {
  for (std::size_t h = 0; h < start.twin.size(); ++h) {
    const auto halfedge = static_cast<Index>(h);
    if (start.twin[h] < halfedge || !start.sharp(halfedge)) continue;
    mesh_.set_line(halfedge,
                   line_between(vertex[at(start.origin(halfedge))], vertex[at(start.target(halfedge))], vertex.size()));
  }
}

/// Would a vertex of the mesh, moved to this triangle of the base, be beyond a crease?
bool IsotropicMesher::crosses(Index face, Index v) const {
  return !region_.empty() && spot(v).hold <= Hold::crease && region_[at(face)] != region_[at(spot(v).place.face)];
}

/// Is what takes the place of an edge's middle beyond a crease of its surroundings?
bool IsotropicMesher::leaves_region(Index h, const Spot& fresh) const {
  if (region_.empty() || fresh.hold > Hold::crease) return false;
  const Index g = mesh_.twin(h), face = fresh.place.face;
  return crosses(face, mesh_.origin(h)) || crosses(face, mesh_.target(h)) ||
         crosses(face, mesh_.origin(previous_halfedge(h))) ||
         (g >= 0 && crosses(face, mesh_.origin(previous_halfedge(g))));
}

/// Is a place on the boundary of the base or on a crease?
bool IsotropicMesher::on_rim(const MeshPlace& place) const {
  const auto open = [&](Index side) { return base_.sharp(3 * place.face + side); };
  return (place.w == 0 && open(0)) || (place.v == 0 && open(2)) || (place.v + place.w >= 1 && open(1));
}

Spot IsotropicMesher::on_surface(const Vec& p, Index from_face) const {
  Spot result;
  result.place = own_place(base_, points_, surface_.closest(p, from_face));
  result.point = surface_.point(result.place);
  result.size = even_ ? sizes_[0] : value_at(base_.triangles, sizes_, result.place);
  return result;
}

Spot IsotropicMesher::on_border(const BorderLines::Place& line) const {
  Spot result{border_.point(line), place_on(line.halfedge, line.along), line.halfedge, Hold::border, sizes_[0]};
  if (!even_) result.size = value_at(base_.triangles, sizes_, result.place);
  return result;
}

Spot IsotropicMesher::on_crease(const CreaseLines::Place& line) const {
  Spot result;
  result.place = place_on(line.halfedge, line.along);
  result.point = surface_.point(result.place);
  result.border = line.halfedge;
  result.hold = Hold::line;
  result.size = even_ ? sizes_[0] : value_at(base_.triangles, sizes_, result.place);
  return result;
}

Spot IsotropicMesher::middle_of_line(Index h) const {
  Index a = mesh_.origin(h), b = mesh_.target(h), line = mesh_.line(h);
  if (line < 0) std::swap(a, b), line = -line;
  return on_crease(lines_.middle(spot(a).hold == Hold::line ? on_crease_line(spot(a)) : lines_.begin(line),
                                 spot(b).hold == Hold::line ? on_crease_line(spot(b)) : lines_.end(line)));
}

Spot IsotropicMesher::middle(Index h) const {
  if (mesh_.line(h) != 0) return middle_of_line(h);
  const Spot &a = spot(mesh_.origin(h)), &b = spot(mesh_.target(h));
  if (mesh_.twin(h) < 0) return on_border(border_.middle(on_line(a), on_line(b)));
  Spot result = on_surface((a.point + b.point) / 2, a.place.face);
  if (a.hold != Hold::free && b.hold != Hold::free && !marked(a.hold) && !marked(b.hold)) result.hold = Hold::crease;
  return result;
}

/// Would cutting an edge leave one that is as long? In a triangle without height beside an edge that cannot be cut,
/// each cut would call for the next one.
bool IsotropicMesher::fans_out(Index h, const Vec& middle) const {
  const Index g = mesh_.twin(h);
  const double most = 0.98 * edge_square(h);
  const auto far = [&](Index side) {
    return (spot(mesh_.origin(previous_halfedge(side))).point - middle).squaredNorm() > most;
  };
  return far(h) || (g >= 0 && far(g));
}

void IsotropicMesher::cut(Index h) {
  const Spot fresh = middle(h);
  // An edge through the inside of a thin part can have its middle nearest to one of its ends.
  const Vec &a = spot(mesh_.origin(h)).point, &b = spot(mesh_.target(h)).point;
  if (mesh_.twin(h) >= 0 && fresh.hold <= Hold::crease && on_rim(fresh.place)) return;
  if (leaves_region(h, fresh)) return;
  if (std::max((fresh.point - a).squaredNorm(), (fresh.point - b).squaredNorm()) > 0.8 * (a - b).squaredNorm()) return;
  if (!lines_.empty() && fans_out(h, fresh.point)) return;
  mesh_.split(h);
  spots_.push_back(fresh);
  stirred_.push_back(true);
  aims_.push_back(aim(fresh.hold));
}

template <class Test>
std::vector<Index> IsotropicMesher::edges_where(Test&& test) const {
  const auto count = at(mesh_.halfedge_count());
  std::vector<std::vector<Index>> parts(chunk_count(count));
  parallel_chunks(parts.size(), [&](std::size_t c) {
    const Index end = static_cast<Index>(std::min(count, (c + 1) * default_chunk));
    for (Index h = static_cast<Index>(c * default_chunk); h < end; ++h)
      if (mesh_.alive(h) && mesh_.twin(h) < h && test(h)) parts[c].push_back(h);
  });
  std::vector<Index> result;
  for (const std::vector<Index>& part : parts) result.insert(result.end(), part.begin(), part.end());
  return result;
}

double IsotropicMesher::longest() const {
  std::vector<double> parts(chunk_count(at(mesh_.halfedge_count())), 0);
  parallel_for(at(mesh_.halfedge_count()), [&](std::size_t begin, std::size_t end) {
    double most = 0;
    for (auto h = static_cast<Index>(begin); h < static_cast<Index>(end); ++h) {
      if (!mesh_.alive(h) || mesh_.twin(h) > h) continue;
      const double wanted = wanted_edge(mesh_.origin(h), mesh_.target(h));
      most = std::max(most, edge_square(h) / (wanted * wanted));
    }
    parts[begin / default_chunk] = most;
  });
  return std::sqrt(*std::max_element(parts.begin(), parts.end()));
}

/// Cuts edges in the middle, long ones first, until none is longer than so many wanted ones.
void IsotropicMesher::split_above(double factor) {
  double limit = std::max(longest() / 1.5, factor);
  for (bool last = false; !last; limit = std::max(limit / 1.5, factor)) {
    last = limit == factor;
    const Index before = mesh_.halfedge_count();
    Index count = 0;
    for (Index h : edges_where([&](Index e) { return longer(e, limit); })) {
      ask_now_and_then(count++);
      if (longer(h, limit)) cut(h);
    }
    for (Index h = before; h < std::min(4 * before, mesh_.halfedge_count()); ++h) {
      ask_now_and_then(h);
      if (mesh_.twin(h) < h && longer(h, limit)) cut(h);
    }
  }
}

/// Where the ends of an edge merge.
Spot IsotropicMesher::merged(Index h) const {
  const Spot &a = spot(mesh_.origin(h)), &b = spot(mesh_.target(h));
  if (a.hold != b.hold) return a.hold > b.hold ? a : b;
  return a.hold == Hold::corner ? a : middle(h);
}

/// The same but for the way back to the surface.
Vec IsotropicMesher::meeting(Index h) const {
  const Spot &a = spot(mesh_.origin(h)), &b = spot(mesh_.target(h));
  if (a.hold != b.hold) return a.hold > b.hold ? a.point : b.point;
  return a.hold == Hold::corner ? a.point : (a.point + b.point) / 2;
}

/// Are all neighbours of a vertex within so many wanted edges of a point?
bool IsotropicMesher::reaches(Index v, const Vec& target, double longest) const {
  bool good = true;
  mesh_.around(v, [&](Index n) {
    const double limit = longest * wanted_edge(v, n);
    good &= (spot(n).point - target).squaredNorm() <= limit * limit;
  });
  return good;
}

/// Does merging one end of an edge with the other turn no triangle over?
bool IsotropicMesher::keeps_form(Index moved, Index other, const Vec& target) const {
  const Index before_first = mesh_.twin(mesh_.outgoing(moved));
  Index last = before_first < 0 ? -1 : mesh_.target(next_halfedge(before_first));
  bool good = true;
  mesh_.around(moved, [&](Index n) {
    if (last >= 0 && n != other && last != other) {
      const Vec &here = spot(moved).point, &p = spot(last).point, &q = spot(n).point;
      const Vec before = (p - here).cross(q - here), after = (p - target).cross(q - target);
      const double product = before.dot(after);  // below 60 degrees
      const bool kept = product >= 0 && product * product >= 0.25 * before.squaredNorm() * after.squaredNorm();
      good &= flat(before, p - here, q - here) || (kept && !flat(after, p - target, q - target));
    }
    last = n;
  });
  return good;
}

/// Do lines keep their course, and apart from each other, when an edge shrinks?
bool IsotropicMesher::keeps_lines(Index h) const {
  const Hold a = spot(mesh_.origin(h)).hold, b = spot(mesh_.target(h)).hold;
  if (mesh_.line(h) == 0 && (marked(a) || marked(b)) && std::min(a, b) >= Hold::line) return false;
  if (mesh_.line(h) != 0 && std::min(a, b) > Hold::line) return false;
  const auto merges_lines = [&](Index side) {
    const Index n = next_halfedge(side), p = previous_halfedge(side);
    const auto sharp = [&](Index e) { return mesh_.line(e) != 0 || mesh_.twin(e) < 0; };
    return sharp(n) && sharp(p) && (mesh_.line(n) != 0 || mesh_.line(p) != 0);
  };
  return !merges_lines(h) && (mesh_.twin(h) < 0 || !merges_lines(mesh_.twin(h)));
}

bool IsotropicMesher::should_collapse(Index h, double longest) const {
  if (!lines_.empty() && !keeps_lines(h)) return false;
  const Index a = mesh_.origin(h), b = mesh_.target(h), g = mesh_.twin(h);
  const Index c = mesh_.origin(previous_halfedge(h)), d = g < 0 ? c : mesh_.origin(previous_halfedge(g));
  if (!may_lose_edge(c) || !may_lose_edge(d)) return false;
  if (mesh_.valence(a) + mesh_.valence(b) - 4 > std::max({9, mesh_.valence(a), mesh_.valence(b)})) return false;
  if (spot(a).hold == Hold::corner && spot(b).hold == Hold::corner && longer(h, 0.3)) return false;
  const Vec target = meeting(h);
  return reaches(a, target, longest) && reaches(b, target, longest) && mesh_.may_collapse(h) &&
         keeps_form(a, b, target) && keeps_form(b, a, target);
}

/// Shrinks edges shorter than so many wanted ones where none longer than 4/3 results, or than `longest` for those
/// shorter than 0.6, which set the largest step.
void IsotropicMesher::collapse_below(double factor, double longest) {
  Index count = 0;
  for (Index h : edges_where([&](Index e) { return !longer(e, factor); })) {
    ask_now_and_then(count++);
    if (!mesh_.alive(h) || longer(h, factor)) continue;
    // With less than 0.6, even lattices of triangles with two short sides and a long one would stay as they are.
    if (!should_collapse(h, longer(h, 0.6) ? 4.0 / 3.0 : longest)) continue;
    const Index a = mesh_.origin(h);
    const Spot target = merged(h);
    if (target.hold <= Hold::crease && (on_rim(target.place) || leaves_region(h, target))) continue;
    if ((target.point - meeting(h)).squaredNorm() > 0.1 * edge_square(h)) continue;  // other than what was tried
    spot(a) = target;
    stirred_[at(a)] = true;
    aims_[at(a)] = aim(spot(a).hold);
    mesh_.collapse(h);
  }
}

/// Vertices of valence 3 or 4 merge with that neighbour where the valences come out best, those of valence 2 on
/// straight boundaries with one beside them.
void IsotropicMesher::drop_low_valences() {
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    if (!mesh_.vertex_alive(v)) continue;
    while (spot(v).hold == Hold::border && mesh_.valence(v) == 2 && mesh_.may_collapse(mesh_.outgoing(v))) {
      spot(v) = spot(mesh_.target(mesh_.outgoing(v)));
      stirred_[at(v)] = true;
      aims_[at(v)] = aim(spot(v).hold);
      mesh_.collapse(mesh_.outgoing(v));
    }
    if (mesh_.valence(v) > 4 || spot(v).hold != Hold::free) continue;
    Index best = -1, most = 4;
    const Index start = mesh_.outgoing(v);
    Index h = start;
    do {
      const Index sides = std::min(mesh_.valence(mesh_.target(next_halfedge(h))),
                                   mesh_.valence(mesh_.origin(previous_halfedge(mesh_.twin(h)))));
      if (sides > most && mesh_.may_collapse(h) && keeps_form(v, mesh_.target(h), spot(mesh_.target(h)).point))
        most = sides, best = h;
      h = mesh_.twin(previous_halfedge(h));
    } while (h != start);
    if (best < 0) continue;
    stirred_[at(mesh_.target(best))] = true;
    mesh_.collapse(mesh_.twin(best));
  }
}

/// Do the two triangles lie nearly in a plane, with the other diagonal inside?
bool IsotropicMesher::flip_keeps_form(Index h) const {
  const Index a = mesh_.origin(h), b = mesh_.target(h);
  const Index c = mesh_.origin(previous_halfedge(h)), d = mesh_.origin(previous_halfedge(mesh_.twin(h)));
  const Vec one = face_normal(a, b, c), two = face_normal(b, a, d);
  const double least = 1e-4 * (one.norm() + two.norm());  // of areas whose direction is more than rounding
  if (std::min(one.norm(), two.norm()) > least && one.dot(two) < 0.5 * one.norm() * two.norm())  // 60 degrees
    return false;
  const Vec mean = (one + two).normalized(), left = face_normal(a, d, c), right = face_normal(d, b, c);
  return left.dot(mean) > std::max(least, 0.7 * left.norm()) && right.dot(mean) > std::max(least, 0.7 * right.norm());
}

/// Turns edges where that brings the valences nearer to 6 (4 on the boundary).
void IsotropicMesher::flip_all() {
  const auto good = [&](Index h) {
    return mesh_.twin(h) >= 0 && mesh_.line(h) == 0 && flip_helps(h) && may_lose_edge(mesh_.origin(h)) &&
           may_lose_edge(mesh_.target(h)) && mesh_.may_flip(h) && flip_keeps_form(h);
  };
  for (Index h : edges_where(good)) {
    if (!good(h)) continue;
    mesh_.flip(h);
    stirred_[at(mesh_.origin(h))] = stirred_[at(mesh_.target(h))] = true;
  }
}

/// Does a vertex that moves turn one of its triangles by more than 60 degrees, or flatten it?
bool IsotropicMesher::turns_over(const Vec& from, const Vec& to, const Index* begin, const Index* end) const {
  const Index* last = end - 1;
  for (const Index* n = begin; n != end; last = n++) {
    const Vec &p = spot(*last).point, &q = spot(*n).point;
    const Vec before = (p - from).cross(q - from), after = (p - to).cross(q - to);
    const double was = before.norm(), is = after.norm();
    if (!flat(before, p - from, q - from) && (before.dot(after) < 0.5 * was * is || is < 0.1 * was)) return true;
  }
  return false;
}

/// A vertex on a line in the middle of its two neighbours there.
Spot IsotropicMesher::relaxed_on_line(Index v, const Index* begin, const Index* end) const {
  const Spot& here = spot(v);
  double ahead = 0, behind = 0;
  const Index start = mesh_.outgoing(v);
  Index h = start;
  do {
    const double length = mesh_.line(h) == 0 ? 0 : (spot(mesh_.target(h)).point - here.point).norm();
    (mesh_.line(h) > 0 ? ahead : behind) += length;
    h = mesh_.twin(previous_halfedge(h));
  } while (h != start);
  // A third: neighbours may do the same.
  const Spot result = on_crease(lines_.advance(on_crease_line(here), (ahead - behind) / 3));
  return turns_over(here.point, result.point, begin, end) ? here : result;
}

/// A vertex in the middle of its triangles' areas; on creases and boundaries in the middle of its two neighbours.
Spot IsotropicMesher::relaxed(Index v, const Index* begin, const Index* end) const {
  const Spot& here = spot(v);
  if (here.hold == Hold::corner || here.hold == Hold::point) return here;
  if (here.hold == Hold::line) return relaxed_on_line(v, begin, end);
  if (here.hold == Hold::border) {
    const double ahead = (spot(*begin).point - here.point).norm(),
                 behind = (spot(*(end - 1)).point - here.point).norm();
    return on_border(border_.advance(on_line(here), (ahead - behind) / 3));  // a third: neighbours may do the same
  }
  Vec centre = Vec::Zero(), normals = Vec::Zero();
  double weight = 0, areas = 0;
  const Spot* last = &spot(*(end - 1));
  Vec from = last->point - here.point;
  for (const Index* n = begin; n != end; ++n) {
    const Spot* next = &spot(*n);
    const Vec to = next->point - here.point, normal = from.cross(to);
    const double area = normal.norm();
    double w = area;
    if (!even_) {  // areas are counted in wanted triangles, squared
      const double size = here.size / (last->size + next->size);
      w *= size * size * size * size;
    }
    centre += w * (from + to);
    weight += w;
    normals += normal;
    areas += area;
    last = next;
    from = to;
  }
  if (!(weight > 0)) return here;
  constexpr double even = 0.8;  // the length of the mean normal; 0.71 on a right-angled edge
  if (normals.norm() >= even * areas) {
    const Vec target = here.point + centre / (3 * weight);
    const Spot result = on_surface(target, here.place.face);
    // Beside its aim, or on an edge that may be one of the boundary, it can come upon its neighbours.
    const bool near = (result.point - target).squaredNorm() < 0.01 * here.size * here.size;
    if (on_rim(result.place) || crosses(result.place.face, v)) return here;
    const bool inside = result.place.v > 0 && result.place.w > 0 && result.place.v + result.place.w < 1;
    return (near && inside) || !turns_over(here.point, result.point, begin, end) ? result : here;
  }

  // On a crease: the neighbours along it are those where the triangles bend by more than 45 degrees.
  const auto n = end - begin;
  Vec along = Vec::Zero();
  int sharp = 0;
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const Vec one = face_normal(v, begin[k], begin[(k + 1) % n]),
              two = face_normal(v, begin[(k + n - 1) % n], begin[k]);
    if (std::min(one.norm(), two.norm()) <= 1e-4 * areas || one.dot(two) >= 0.7 * one.norm() * two.norm()) continue;
    along += spot(begin[k]).point / 2;
    ++sharp;
  }
  Spot result = sharp == 2 ? on_surface(along, here.place.face) : here;
  if (crosses(result.place.face, v) || turns_over(here.point, result.point, begin, end)) result = here;
  result.hold = Hold::crease;
  return result;
}

/// Where a vertex and its neighbours have come to rest, they are left there.
void IsotropicMesher::relax(int times) {
  struct Move {
    std::size_t vertex;
    Spot to;
  };
  const Rings rings(mesh_);
  constexpr std::size_t chunk = 512;
  std::vector<std::vector<Move>> moves(chunk_count(spots_.size(), chunk));
  const auto restless = [&](std::size_t v) {
    return stirred_[v] || std::any_of(rings.begin(v), rings.end(v), [&](Index n) { return stirred_[at(n)] != 0; });
  };
  for (int i = 0; i < times; ++i) {
    ask();
    parallel_for(
        spots_.size(),
        [&](std::size_t begin, std::size_t end) {
          std::vector<Move>& here = moves[begin / chunk];
          here.clear();
          for (std::size_t v = begin; v < end; ++v)
            if (rings.begin(v) < rings.end(v) && restless(v))
              here.push_back({v, relaxed(static_cast<Index>(v), rings.begin(v), rings.end(v))});
        },
        chunk);
    std::fill(stirred_.begin(), stirred_.end(), false);
    parallel_chunks(moves.size(), [&](std::size_t c) {
      for (const Move& m : moves[c]) {
        const double still = at_rest * m.to.size;
        stirred_[m.vertex] = (m.to.point - spots_[m.vertex].point).squaredNorm() > still * still;
        spots_[m.vertex] = m.to;
      }
    });
  }
}

void IsotropicMesher::pack() {
  const std::vector<Index> old = mesh_.pack();
  std::vector<Spot> spots(old.size());
  stirred_.assign(old.size(), true);
  aims_.resize(old.size());
  parallel_for(old.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) aims_[v] = aim((spots[v] = spots_[at(old[v])]).hold);
  });
  spots_ = std::move(spots);
}

IsotropicMesh IsotropicMesher::run(double wanted) {
  const auto room = static_cast<std::size_t>(wanted) + spots_.size();
  mesh_.reserve(room);
  spots_.reserve(room);
  aims_.reserve(room);
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    ask();
    split_above(4.0 / 3.0);
    ask();
    if (round == 0) pack();
    if (round == 0)
      for (double factor : {0.2, 0.4}) collapse_below(factor, 4.0 / 3.0);
    collapse_below(4.0 / 5.0, 5.0 / 3.0);
    ask();
    flip_all();
    relax(round + 1 < rounds ? 1 : 2);
    // Much smaller, and the limits would cut a mesh that is even but a little coarse at all its edges.
    done_ = (round + 1) / (rounds + 1.0);
    if (round > 0) scale_ = std::clamp(scale_ * std::sqrt(mesh_.live_faces() / (1.02 * wanted)), 0.9, 1.1);
  }
  collapse_below(0.5, 5.0 / 3.0);
  drop_low_valences();
  flip_all();
  relax(2);
  pack();
  IsotropicMesh result{mesh_.topology(), {}, {}};
  for (std::size_t v = 0; result.topology.creases.any() && v < spots_.size(); ++v)
    result.topology.creases.corner[v] = spots_[v].hold >= Hold::point;
  result.places.reserve(spots_.size());
  for (const Spot& s : spots_) result.places.push_back(s.place);
  return result;
}

}  // namespace

IsotropicMesh isotropic_mesh(const std::vector<Triangle>& triangles, const std::vector<Point>& points, double edge) {
  return isotropic_mesh(triangles, points, std::vector<double>(points.size(), edge));
}

IsotropicMesh isotropic_mesh(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                             const std::vector<double>& edges) {
  return isotropic_mesh(Hierarchy(make_topology(points.size(), triangles), midpoint_refine), points, edges);
}

IsotropicMesh isotropic_mesh(const Hierarchy& levels, const std::vector<Point>& points, std::vector<double> edges,
                             const Progress& progress) {
  for (double edge : edges)
    if (!(edge > 0)) throw Error(Fault::usage, "the wanted edge length must be positive");
  const Topology& base = levels.topology(levels.finest());
  if (base.triangles.empty()) return {};
  if (std::adjacent_find(edges.begin(), edges.end(), std::not_equal_to<>()) != edges.end())
    limit_slope(base, points, 0.3, edges);
  const double wanted = wanted_faces(base, points, edges);
  if (!(wanted <= most_faces))
    throw Error(Fault::usage, "edges that short would make more than 100 million triangles; make them longer");
  int start = levels.finest();  // half to twice as many triangles as wanted
  while (start > 0 && static_cast<double>(levels.topology(start).triangles.size()) > 2 * wanted) --start;
  const std::vector<Point> uneven = without_symmetry(points, *std::min_element(edges.begin(), edges.end()));
  report(progress, "meshing", 0);
  const OwnOrder order = own_order(levels.topology(start), uneven);
  report(progress, "meshing", 0);
  IsotropicMesh mesh = IsotropicMesher(base, uneven, std::move(edges), order, progress).run(wanted);
  mesh.points.resize(mesh.places.size());
  parallel_for(mesh.points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) mesh.points[v] = point_at(base.triangles, points, mesh.places[v]);
  });
  return mesh;
}

}  // namespace pelage
