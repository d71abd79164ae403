#include "shape/describe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "shape/edges.h"
#include "shape/repair.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Gathers a Spread.
class Gather {
 public:
  void add(double x) {
    min_ = std::min(min_, x);
    max_ = std::max(max_, x);
    sum_ += x;
    ++count_;
  }
  Spread range() const { return count_ ? Spread{min_, sum_ / static_cast<double>(count_), max_} : Spread{}; }

 private:
  double min_ = std::numeric_limits<double>::infinity(), max_ = -min_, sum_ = 0;
  std::size_t count_ = 0;
};

/// Smallest triangle number of each triangle's component, joined over the edges.
std::vector<std::int32_t> components_of(const TriangleMesh& mesh, const EdgeTable& edges) {
  std::vector<std::int32_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](std::int32_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (HalfEdge h : edges[e].subspan(1)) {
      const std::int32_t a = root(edges[e][0] / 3), b = root(h / 3);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(parent.size()); ++f) parent[f] = root(f);
  return parent;
}

void describe_edges(const TriangleMesh& mesh, const EdgeTable& edges, MeshReport& report) {
  std::vector<int> valence(mesh.points.size(), 0);
  std::vector<std::int32_t> next(mesh.points.size(), -1);  // along the boundary
  Gather lengths;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::int32_t a = tail(mesh.triangles, edges[e][0]), b = tip(mesh.triangles, edges[e][0]);
    lengths.add(length(difference(mesh.points[a], mesh.points[b])));
    ++valence[a];
    ++valence[b];
    if (edges[e].size() > 1) continue;
    ++report.boundary_edges;
    next[a] = b;
  }
  for (int n : valence) ++report.valences[n];
  report.edges = edges.size();
  report.edge_length = lengths.range();
  report.closed = report.boundary_edges == 0;
  for (std::size_t start = 0; start < next.size(); ++start) {
    if (next[start] < 0) continue;
    ++report.boundary_loops;
    for (auto v = static_cast<std::int32_t>(start); v >= 0;) v = std::exchange(next[v], -1);
  }
}

void describe_components(const TriangleMesh& mesh, const EdgeTable& edges, MeshReport& report) {
  const std::vector<std::int32_t> component = components_of(mesh, edges);
  std::vector<char> open(component.size(), 0);  // by the component's first triangle
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() == 1) open[component[edges[e][0] / 3]] = 1;
  for (std::size_t f = 0; f < component.size(); ++f) {
    report.components += component[f] == static_cast<std::int32_t>(f);
    if (open[component[f]]) continue;
    const Point& origin = mesh.points[mesh.triangles[component[f]][0]];
    const auto& [a, b, c] = mesh.triangles[f];
    report.volume += dot(difference(mesh.points[a], origin),
                         cross(difference(mesh.points[b], origin), difference(mesh.points[c], origin))) /
                     6;
  }
  report.euler_characteristic =
      static_cast<long>(report.vertices) - static_cast<long>(report.edges) + static_cast<long>(report.faces);
  report.genus = (2 * static_cast<long>(report.components) - static_cast<long>(report.boundary_loops) -
                  report.euler_characteristic) /
                 2;
}

void describe_faces(const TriangleMesh& mesh, MeshReport& report) {
  Gather angles;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Point& p = mesh.points[t[k]];
      const Point u = difference(mesh.points[t[(k + 1) % 3]], p), v = difference(mesh.points[t[(k + 2) % 3]], p);
      const double twice_area = length(cross(u, v));
      angles.add(std::atan2(twice_area, dot(u, v)) * 180 / std::numbers::pi);
      if (k == 0) report.area += twice_area / 2;
    }
  report.angle = angles.range();
}

void describe_box(const TriangleMesh& mesh, MeshReport& report) {
  if (mesh.points.empty()) return;
  report.low = report.high = mesh.points[0];
  for (const Point& p : mesh.points)
    for (int k = 0; k < 3; ++k) {
      report.low[k] = std::min(report.low[k], p[k]);
      report.high[k] = std::max(report.high[k], p[k]);
    }
  report.diagonal = length(difference(report.high, report.low));
}

/// "id (1 per vertex, int32)", "material (1 per face): 0 Fur, 1 Glass".
std::string described(const Attribute& a) {
  const char* domain = a.domain == Domain::vertex ? "vertex" : a.domain == Domain::corner ? "corner" : "face";
  std::string text = a.name + " (" + std::to_string(a.components) + " per " + domain;
  const bool usual = a.type == NumberType::float32 || is_color(a) || a.name == "uv" || !a.labels.empty();
  if (!usual) text += std::string(", ") + name_of(a.type);
  text += a.labels.empty() ? ")" : "):";
  constexpr std::size_t most_labels = 8;
  for (std::size_t i = 0; i < std::min(a.labels.size(), most_labels); ++i)
    text += (i ? ", " : " ") + std::to_string(i) + " " + a.labels[i];
  if (a.labels.size() > most_labels) text += ", and " + std::to_string(a.labels.size() - most_labels) + " more";
  return text;
}

}  // namespace

MeshReport describe(const TriangleMesh& mesh, std::vector<Finding> findings) {
  MeshReport report;
  report.vertices = mesh.points.size();
  report.faces = mesh.triangles.size();
  report.findings = std::move(findings);
  const EdgeTable edges(mesh.triangles, mesh.points.size());
  describe_edges(mesh, edges, report);
  describe_components(mesh, edges, report);
  describe_faces(mesh, report);
  describe_box(mesh, report);
  for (const Attribute& a : mesh.attributes) report.attributes.push_back(described(a));
  return report;
}

MeshReport describe(const TriangleMesh& mesh) {
  std::vector<Finding> findings;
  repair(mesh, findings);
  return describe(mesh, std::move(findings));
}

}  // namespace pelage
