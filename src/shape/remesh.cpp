#include "shape/remesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "shape/topology.h"

namespace pelage {

namespace {

using Vec = Eigen::Vector3d;

/// An edge with its two corners: corner c = 3 f + k of triangle f is the half-edge from vertex k to vertex k + 1.
struct Edge {
  int corner, twin;
  double length;
};

/// Connectivity, built anew for every pass after one that changed it; a pass changes only places that do not touch each
/// other.
class Remesher {
 public:
  explicit Remesher(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
    for (const Point& p : mesh.points) points_.emplace_back(p.data());
  }

  std::size_t size() const { return points_.size(); }
  double area() const {
    double sum = 0;
    for (std::size_t f = 0; f < triangles_.size(); ++f) sum += normal(triangles_[f]).norm() / 2;
    return sum;
  }
  TriangleMesh mesh() const {
    TriangleMesh mesh;
    mesh.triangles = triangles_;
    for (const Vec& p : points_) mesh.points.push_back({p.x(), p.y(), p.z()});
    return mesh;
  }

  void split(double longest);
  void collapse(double shortest, double longest);
  void flip();
  void relax(const std::function<Point(const Point&)>& project);

 private:
  int vertex(int corner) const { return triangles_[corner / 3][corner % 3]; }
  Vec normal(const Triangle& t) const { return (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]); }
  int valence(int v) const { return first_[v + 1] - first_[v]; }
  void gather_corners();
  /// Those for which length_fits(length) and test(edge) hold, by their first corner.
  template <class LengthFits, class Test>
  std::vector<Edge> edges_where(LengthFits&& length_fits, Test&& test) const;
  bool adjacent(int a, int b) const;
  int common_neighbours(int a, int b) const;
  bool may_collapse(const Edge& edge, double longest) const;
  bool should_flip(const Edge& edge) const;
  bool keeps_normals(int moved, int other, const Vec& target) const;
  int flip_gain(int a, int b, int c, int d) const;

  std::vector<Vec> points_;
  std::vector<Triangle> triangles_;
  std::vector<int> first_, corners_;  ///< the corners at vertex v are corners_[first_[v] .. first_[v + 1])
  std::vector<int> targets_;          ///< of the half-edges there
  bool gathered_ = false;             ///< are these of the triangles as they are?
};

void Remesher::gather_corners() {
  if (gathered_) return;
  gathered_ = true;
  first_.assign(points_.size() + 1, 0);
  const int count = static_cast<int>(3 * triangles_.size());
  for (int c = 0; c < count; ++c) ++first_[vertex(c) + 1];
  for (std::size_t v = 0; v < points_.size(); ++v) first_[v + 1] += first_[v];
  corners_.resize(count);
  targets_.resize(count);
  std::vector<int> fill(first_.begin(), first_.end() - 1);
  for (int c = 0; c < count; ++c) {
    const int place = fill[vertex(c)]++;
    corners_[place] = c;
    targets_[place] = vertex(next_halfedge(c));
  }
}

template <class LengthFits, class Test>
std::vector<Edge> Remesher::edges_where(LengthFits&& length_fits, Test&& test) const {
  const std::size_t corners = 3 * triangles_.size();
  std::vector<std::vector<Edge>> parts(chunk_count(corners));
  parallel_for(corners, [&](std::size_t begin, std::size_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      const int a = vertex(c), b = vertex(next_halfedge(c));
      if (a > b) continue;
      const double length = (points_[a] - points_[b]).norm();
      if (!length_fits(length)) continue;
      const auto twin = std::find(targets_.begin() + first_[b], targets_.begin() + first_[b + 1], a);
      assert(twin != targets_.begin() + first_[b + 1]);
      const Edge edge{c, corners_[twin - targets_.begin()], length};
      if (test(edge)) parts[begin / default_chunk].push_back(edge);
    }
  });
  std::vector<Edge> edges;
  for (const std::vector<Edge>& part : parts) edges.insert(edges.end(), part.begin(), part.end());
  return edges;
}

bool Remesher::adjacent(int a, int b) const {
  const auto end = targets_.begin() + first_[a + 1];
  return std::find(targets_.begin() + first_[a], end, b) != end;
}

int Remesher::common_neighbours(int a, int b) const {
  return static_cast<int>(std::count_if(targets_.begin() + first_[a], targets_.begin() + first_[a + 1],
                                        [&](int v) { return adjacent(v, b); }));
}

/// Cuts all edges above the limit in the middle; a triangle with one, two or three cuts becomes two, three or four.
void Remesher::split(double longest) {
  gather_corners();
  std::vector<int> middle(3 * triangles_.size(), -1);
  const std::size_t before = points_.size();
  const auto any = [](const Edge&) { return true; };
  for (const Edge& e : edges_where([&](double length) { return length > longest; }, any)) {
    middle[e.corner] = middle[e.twin] = static_cast<int>(points_.size());
    points_.emplace_back((points_[vertex(e.corner)] + points_[vertex(next_halfedge(e.corner))]) / 2);
  }
  if (points_.size() == before) return;
  gathered_ = false;
  std::vector<Triangle> result;
  for (int f = 0; f < static_cast<int>(triangles_.size()); ++f) {
    const int cuts = static_cast<int>(std::count_if(&middle[3 * f], &middle[3 * f] + 3, [](int m) { return m >= 0; }));
    int k = 0;  // turn the triangle so that its first edge is cut and, of two cuts, the last edge is not
    while (k < 2 && (cuts == 1 ? middle[3 * f + k] < 0 : cuts == 2 && middle[3 * f + (k + 2) % 3] >= 0)) ++k;
    const auto& t = triangles_[f];
    const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    const int ab = middle[3 * f + k], bc = middle[3 * f + (k + 1) % 3], ca = middle[3 * f + (k + 2) % 3];
    if (cuts == 0) result.push_back(t);
    if (cuts == 1) result.insert(result.end(), {{a, ab, c}, {ab, b, c}});
    if (cuts == 2) {
      result.push_back({ab, b, bc});
      if ((points_[ab] - points_[c]).norm() < (points_[a] - points_[bc]).norm())
        result.insert(result.end(), {{a, ab, c}, {ab, bc, c}});
      else
        result.insert(result.end(), {{a, ab, bc}, {a, bc, c}});
    }
    if (cuts == 3) result.insert(result.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  triangles_ = std::move(result);
}

/// Would moving a vertex to `target` turn over one of its triangles that do not contain `other`?
bool Remesher::keeps_normals(int moved, int other, const Vec& target) const {
  for (int i = first_[moved]; i < first_[moved + 1]; ++i) {
    const int p = vertex(next_halfedge(corners_[i])), q = vertex(previous_halfedge(corners_[i]));
    if (p == other || q == other) continue;
    const Vec before = (points_[p] - points_[moved]).cross(points_[q] - points_[moved]);
    const Vec after = (points_[p] - target).cross(points_[q] - target);
    if (before.dot(after) < 0.5 * before.norm() * after.norm()) return false;
  }
  return true;
}

bool Remesher::may_collapse(const Edge& edge, double longest) const {
  const int a = vertex(edge.corner), b = vertex(edge.twin);
  const int c = vertex(previous_halfedge(edge.corner)), d = vertex(previous_halfedge(edge.twin));
  if (valence(a) + valence(b) - 4 > 8 || valence(c) < 5 || valence(d) < 5) return false;
  const Vec middle = (points_[a] + points_[b]) / 2;
  for (int v : {a, b})
    for (int i = first_[v]; i < first_[v + 1]; ++i)
      if ((points_[vertex(next_halfedge(corners_[i]))] - middle).norm() > longest) return false;
  if (common_neighbours(a, b) != 2) return false;  // more: the collapse would pinch the surface
  return keeps_normals(a, b, middle) && keeps_normals(b, a, middle);
}

/// Shrinks edges below the limit to their middle, shortest first, where no edge above `longest` results.
void Remesher::collapse(double shortest, double longest) {
  gather_corners();
  std::vector<Edge> candidates = edges_where([&](double length) { return length < shortest; },
                                             [&](const Edge& e) { return may_collapse(e, longest); });
  std::sort(candidates.begin(), candidates.end(),
            [](const Edge& p, const Edge& q) { return std::tie(p.length, p.corner) < std::tie(q.length, q.corner); });
  std::vector<char> touched(points_.size(), false);
  std::vector<int> name(points_.size());
  for (std::size_t v = 0; v < name.size(); ++v) name[v] = static_cast<int>(v);
  for (const Edge& e : candidates) {
    const int a = vertex(e.corner), b = vertex(next_halfedge(e.corner));
    if (touched[a] || touched[b]) continue;
    for (int v : {a, b})
      for (int i = first_[v]; i < first_[v + 1]; ++i) touched[vertex(next_halfedge(corners_[i]))] = true;
    points_[a] = (points_[a] + points_[b]) / 2;
    name[b] = a;
    gathered_ = false;
  }
  if (gathered_) return;
  std::vector<int> number(points_.size(), -1);
  std::vector<Vec> kept;
  for (std::size_t v = 0; v < name.size(); ++v) {
    if (name[v] != static_cast<int>(v)) continue;
    number[v] = static_cast<int>(kept.size());
    kept.push_back(points_[v]);
  }
  points_ = std::move(kept);
  for (Triangle& t : triangles_)
    for (auto& v : t) v = number[name[v]];
  std::erase_if(triangles_, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

/// How much nearer to 6 the valences come when edge ab between triangles abc and bad becomes cd.
int Remesher::flip_gain(int a, int b, int c, int d) const {
  auto defect = [&](int v, int change) { return (valence(v) + change - 6) * (valence(v) + change - 6); };
  return defect(a, 0) + defect(b, 0) + defect(c, 0) + defect(d, 0) - defect(a, -1) - defect(b, -1) - defect(c, 1) -
         defect(d, 1);
}

/// Does turning it bring the valences nearer to 6 and bend no triangle away from the surface?
bool Remesher::should_flip(const Edge& e) const {
  const int a = vertex(e.corner), b = vertex(next_halfedge(e.corner));
  const int c = vertex(previous_halfedge(e.corner)), d = vertex(previous_halfedge(e.twin));
  if (flip_gain(a, b, c, d) <= 0 || adjacent(c, d)) return false;
  const Vec one = normal({a, d, c}), two = normal({d, b, c});
  const Vec n = normal(triangles_[e.corner / 3]).normalized() + normal(triangles_[e.twin / 3]).normalized();
  return !(one.dot(n) < one.norm() || two.dot(n) < two.norm());
}

void Remesher::flip() {
  gather_corners();
  std::vector<char> touched(points_.size(), false);
  const auto any = [](double) { return true; };
  for (const Edge& e : edges_where(any, [&](const Edge& edge) { return should_flip(edge); })) {
    const int a = vertex(e.corner), b = vertex(next_halfedge(e.corner));
    const int c = vertex(previous_halfedge(e.corner)), d = vertex(previous_halfedge(e.twin));
    if (touched[a] || touched[b] || touched[c] || touched[d]) continue;
    triangles_[e.corner / 3] = {a, d, c};
    triangles_[e.twin / 3] = {d, b, c};
    gathered_ = false;
    for (int v : {a, b, c, d}) touched[v] = true;
  }
}

/// Moves every vertex to the area-weighted centre of its triangles, within the tangent plane, and onto the surface.
void Remesher::relax(const std::function<Point(const Point&)>& project) {
  gather_corners();
  std::vector<Vec> moved(points_.size());
  parallel_for(points_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Vec centre = Vec::Zero(), normals = Vec::Zero();
      double weight = 0;
      for (int i = first_[v]; i < first_[v + 1]; ++i) {
        const Triangle& t = triangles_[corners_[i] / 3];
        const Vec n = normal(t);
        centre += n.norm() / 3 * (points_[t[0]] + points_[t[1]] + points_[t[2]]);
        weight += n.norm();
        normals += n;
      }
      const Vec n = normals.normalized(), step = centre / weight - points_[v];
      const Vec target = points_[v] + step - n.dot(step) * n;
      const Point p = project({target.x(), target.y(), target.z()});
      moved[v] = Vec(p.data());
    }
  });
  points_ = std::move(moved);
}

}  // namespace

TriangleMesh remesh(const TriangleMesh& mesh, std::size_t vertices, const std::function<Point(const Point&)>& project) {
  Remesher remesher(mesh);
  // Equilateral triangles of edge L take sqrt(3)/2 L^2 per vertex; the rounds correct what the limits make of it.
  double edge = std::sqrt(2 / std::sqrt(3.0) * remesher.area() / static_cast<double>(vertices));
  constexpr int rounds = 12;  // the count and the valences change by less than 1 % per round after about ten
  for (int round = 0; round < rounds; ++round) {
    // A cut of an edge above 4/3 L or a collapse below 4/5 L leaves edges that are nearer to L than before.
    remesher.split(4.0 / 3.0 * edge);
    for (std::size_t before = 0; before != remesher.size();) {
      before = remesher.size();
      remesher.collapse(4.0 / 5.0 * edge, 4.0 / 3.0 * edge);
    }
    remesher.flip();
    remesher.flip();
    remesher.relax(project);
    const double excess = static_cast<double>(remesher.size()) / static_cast<double>(vertices);
    if (round > 3) edge *= std::clamp(std::sqrt(excess), 0.9, 1.1);
  }
  for (int round = 0; round < 10; ++round) {
    remesher.flip();
    remesher.relax(project);
  }
  return remesher.mesh();
}

}  // namespace pelage
