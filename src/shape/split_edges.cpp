#include "shape/split_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/checked.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

using Edge = std::pair<std::int32_t, std::int32_t>;  ///< its ends in order
Edge edge_between(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

Point middle(const Point& a, const Point& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

/// A corner of a part of a triangle: one of its corners, where both are the same, or the middle between two.
struct PartCorner {
  std::size_t a, b;
};
using Part = std::array<PartCorner, 3>;

class EdgeSplitter {
 public:
  EdgeSplitter(TriangleMesh& mesh, double longest) : mesh_(mesh), longest_(longest) {}

  bool split() {
    find_edges();
    if (edges_.empty()) return false;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const std::size_t before = parts_.size();
      split_triangle(mesh_.triangles[f]);
      parent_.insert(parent_.end(), parts_.size() - before, f);
    }
    for (Attribute& a : mesh_.attributes) split_attribute(a);
    for (const auto& [a, b] : edges_) mesh_.points.push_back(middle(mesh_.points[at(a)], mesh_.points[at(b)]));
    mesh_.triangles = finer_triangles();
    return true;
  }

 private:
  double length_of(std::int32_t a, std::int32_t b) const {
    const auto [low, high] = edge_between(a, b);
    return length(difference(mesh_.points[at(high)], mesh_.points[at(low)]));
  }

  void find_edges() {
    for (const Triangle& t : mesh_.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (length_of(t[k], t[(k + 1) % 3]) > longest_) edges_.push_back(edge_between(t[k], t[(k + 1) % 3]));
    std::ranges::sort(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    first_middle_ = checked_count<std::int32_t>(mesh_.points.size(), "vertices");
    checked_count<std::int32_t>(mesh_.points.size() + edges_.size(), "vertices");
  }

  bool is_split(std::int32_t a, std::int32_t b) const { return std::ranges::binary_search(edges_, edge_between(a, b)); }
  std::int32_t middle_of(std::int32_t a, std::int32_t b) const {
    const auto found = std::ranges::lower_bound(edges_, edge_between(a, b));
    return first_middle_ + static_cast<std::int32_t>(found - edges_.begin());
  }

  void split_triangle(const Triangle& t) {
    std::array<bool, 3> is{};
    for (std::size_t k = 0; k < 3; ++k) is[k] = is_split(t[k], t[(k + 1) % 3]);
    const auto count = std::ranges::count(is, true);
    if (count == 0) return parts_.push_back({{{0, 0}, {1, 1}, {2, 2}}});
    if (count == 3) {
      for (const Part& part : {Part{{{0, 0}, {0, 1}, {2, 0}}},
                               {{{0, 1}, {1, 1}, {1, 2}}},
                               {{{2, 0}, {1, 2}, {2, 2}}},
                               {{{0, 1}, {1, 2}, {2, 0}}}})
        parts_.push_back(part);
      return;
    }
    // From corner i the edge to j is split, and of two the one before it is not.
    std::size_t i = 0;
    while (!is[i] || (count == 2 && is[(i + 2) % 3])) ++i;
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (count == 1) {
      parts_.push_back({{{i, i}, {i, j}, {k, k}}});
      parts_.push_back({{{i, j}, {j, j}, {k, k}}});
      return;
    }
    // What is left at the third edge is cut along the shorter diagonal.
    parts_.push_back({{{i, j}, {j, j}, {j, k}}});
    const Point &a = mesh_.points[at(t[i])], &b = mesh_.points[at(t[j])], &c = mesh_.points[at(t[k])];
    if (length(difference(middle(b, c), a)) <= length(difference(middle(a, b), c))) {
      parts_.push_back({{{i, i}, {i, j}, {j, k}}});
      parts_.push_back({{{i, i}, {j, k}, {k, k}}});
    } else {
      parts_.push_back({{{i, i}, {i, j}, {k, k}}});
      parts_.push_back({{{i, j}, {j, k}, {k, k}}});
    }
  }

  std::vector<Triangle> finer_triangles() const {
    std::vector<Triangle> finer;
    finer.reserve(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Triangle& t = mesh_.triangles[parent_[p]];
      Triangle& part = finer.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [a, b] = parts_[p][c];
        part[c] = a == b ? t[a] : middle_of(t[a], t[b]);
      }
    }
    return finer;
  }

  void split_attribute(Attribute& a) const {
    const auto n = static_cast<std::size_t>(a.components);
    const auto mean = [&](std::size_t i, std::size_t j, std::vector<double>& values) {
      for (std::size_t k = 0; k < n; ++k)
        values.push_back(i == j ? a.values[n * i + k] : (a.values[n * i + k] + a.values[n * j + k]) / 2);
    };
    std::vector<double> finer = a.domain == Domain::vertex ? a.values : std::vector<double>();
    if (a.domain == Domain::vertex)
      for (const auto& [i, j] : edges_) mean(at(i), at(j), finer);
    for (std::size_t p = 0; p < parts_.size() && a.domain != Domain::vertex; ++p) {
      if (a.domain == Domain::face) mean(parent_[p], parent_[p], finer);
      if (a.domain == Domain::corner)
        for (const auto& [i, j] : parts_[p]) mean(3 * parent_[p] + i, 3 * parent_[p] + j, finer);
    }
    a.values = std::move(finer);
    if (a.domain != Domain::face) widen(a);
  }

  TriangleMesh& mesh_;
  double longest_;
  std::vector<Edge> edges_;  ///< those that are split
  std::int32_t first_middle_ = 0;
  std::vector<Part> parts_;
  std::vector<std::size_t> parent_;  ///< of the parts
};

}  // namespace

bool split_edges(TriangleMesh& mesh, double longest) { return EdgeSplitter(mesh, longest).split(); }

void split_long_edges(TriangleMesh& mesh, double longest, std::size_t most_triangles) {
  double area = 0;
  for (const Triangle& t : mesh.triangles)
    area += length(cross(difference(mesh.points[at(t[1])], mesh.points[at(t[0])]),
                         difference(mesh.points[at(t[2])], mesh.points[at(t[0])]))) /
            2;
  // Of triangles that were split so long, whose edges are between half of it and all.
  constexpr double area_of_one = 0.2;
  longest = std::max(longest, std::sqrt(area / (area_of_one * static_cast<double>(most_triangles))));
  while (mesh.triangles.size() < most_triangles && split_edges(mesh, longest)) {
  }
}

}  // namespace pelage
