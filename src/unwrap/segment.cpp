#include "unwrap/segment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <queue>
#include <utility>

namespace pelage {

namespace {

using Eigen::Vector3d;

Vector3d at(const LinkedFaces& faces, std::int32_t place) { return Vector3d(faces.points[place].data()); }

/// What regions are compared by.
struct Region {
  Vector3d sum = Vector3d::Zero();  ///< of areas times normals
  double area = 0;
  Vector3d axis() const { return sum.normalized(); }
  double spread() const { return 1 - sum.norm() / area; }
};

std::vector<Region> regions_of(const FaceGraph& graph, const std::vector<std::int32_t>& label, std::size_t count) {
  std::vector<Region> regions(count);
  for (std::size_t f = 0; f < label.size(); ++f) {
    regions[label[f]].sum += graph.area[f] * graph.normal[f];
    regions[label[f]].area += graph.area[f];
  }
  return regions;
}

double misfit(const FaceGraph& graph, std::size_t f, const Vector3d& axis) { return 1 - graph.normal[f].dot(axis); }

/// Regions grow from their seeds over what fits best.
class Growth {
 public:
  explicit Growth(const FaceGraph& graph) : graph_(graph) {}

  std::vector<std::int32_t> grow(const std::vector<std::int32_t>& seeds, const std::vector<Vector3d>& axes) {
    label_.assign(graph_.size(), -1);
    for (std::size_t r = 0; r < seeds.size(); ++r)
      if (label_[seeds[r]] < 0) take(seeds[r], static_cast<std::int32_t>(r), axes);
    while (!queue_.empty()) {
      const Step step = queue_.top();
      queue_.pop();
      if (label_[step.face] < 0) take(step.face, step.region, axes);
    }
    return label_;
  }

 private:
  struct Step {
    double misfit;
    std::int64_t turn;  ///< the order of equals
    std::int32_t face, region;
    bool operator<(const Step& other) const {
      return misfit != other.misfit ? misfit > other.misfit : turn > other.turn;
    }
  };
  void take(std::int32_t face, std::int32_t region, const std::vector<Vector3d>& axes) {
    label_[face] = region;
    for (std::size_t l = graph_.start[face]; l < graph_.start[face + 1]; ++l) {
      const std::int32_t next = graph_.links[l].face;
      if (label_[next] < 0) queue_.push({misfit(graph_, next, axes[region]), turn_++, next, region});
    }
  }

  const FaceGraph& graph_;
  std::vector<std::int32_t> label_;
  std::priority_queue<Step> queue_;
  std::int64_t turn_ = 0;
};

/// The face of every region that fits it best, or worst.
std::vector<std::int32_t> extreme_faces(const FaceGraph& graph, const std::vector<std::int32_t>& label,
                                        const std::vector<Vector3d>& axes, double sign) {
  std::vector<std::int32_t> face(axes.size(), -1);
  std::vector<double> least(axes.size(), 0);
  for (std::size_t f = 0; f < label.size(); ++f) {
    const double m = sign * misfit(graph, f, axes[label[f]]);
    if (face[label[f]] >= 0 && m >= least[label[f]]) continue;
    face[label[f]] = static_cast<std::int32_t>(f);
    least[label[f]] = m;
  }
  return face;
}

std::vector<Vector3d> axes_of(const std::vector<Region>& regions) {
  std::vector<Vector3d> axes;
  for (const Region& r : regions) axes.push_back(r.axis());
  return axes;
}

/// Lloyd's iteration; labels stay those of regions that are not empty.
std::vector<std::int32_t> relaxed(const FaceGraph& graph, std::vector<std::int32_t> label, std::size_t count,
                                  int steps) {
  Growth growth(graph);
  for (int step = 0; step < steps; ++step) {
    const std::vector<Vector3d> axes = axes_of(regions_of(graph, label, count));
    label = growth.grow(extreme_faces(graph, label, axes, 1), axes);
  }
  return label;
}

/// Regions are what hangs together with one label.
std::vector<std::int32_t> pieces(const FaceGraph& graph, const std::vector<std::int32_t>& label,
                                 std::size_t* count = nullptr) {
  std::vector<std::int32_t> piece(graph.size(), -1), open;
  std::int32_t number = 0;
  for (std::size_t f = 0; f < graph.size(); ++f) {
    if (piece[f] >= 0) continue;
    piece[f] = number;
    open.push_back(static_cast<std::int32_t>(f));
    while (!open.empty()) {
      const std::int32_t face = open.back();
      open.pop_back();
      for (std::size_t l = graph.start[face]; l < graph.start[face + 1]; ++l) {
        const std::int32_t next = graph.links[l].face;
        if (piece[next] >= 0 || (!label.empty() && label[next] != label[face])) continue;
        piece[next] = number;
        open.push_back(next);
      }
    }
    ++number;
  }
  if (count) *count = static_cast<std::size_t>(number);
  return piece;
}

/// What a seam along an edge costs: its length, and along creases less of it.
double seam_cost(const FaceGraph& graph, std::size_t face, const FaceGraph::Link& link) {
  return link.length * std::max(0.1, graph.normal[face].dot(graph.normal[link.face]));
}

/// The region around a face to which it would have the shorter border.
std::int32_t better_region(const FaceGraph& graph, const std::vector<std::int32_t>& label, std::size_t f) {
  const auto shared = [&](std::int32_t region) {
    double sum = 0;
    for (std::size_t l = graph.start[f]; l < graph.start[f + 1]; ++l)
      if (label[graph.links[l].face] == region) sum += seam_cost(graph, f, graph.links[l]);
    return sum;
  };
  std::int32_t best = label[f];
  double most = shared(best) * (1 + 1e-9);
  for (std::size_t l = graph.start[f]; l < graph.start[f + 1]; ++l) {
    const std::int32_t region = label[graph.links[l].face];
    const double sum = region == best ? 0 : shared(region);
    if (sum <= most) continue;
    best = region;
    most = sum;
  }
  return best;
}

constexpr int smoothing_passes = 6;

/// Faces change to the region beside them where that shortens the border and the face does not lean away from it.
void smooth_borders(const FaceGraph& graph, std::vector<std::int32_t>& label, std::size_t count) {
  std::vector<std::int32_t> size(count, 0);
  for (const std::int32_t r : label) ++size[r];
  const std::vector<Vector3d> axes = axes_of(regions_of(graph, label, count));
  for (int pass = 0; pass < smoothing_passes; ++pass)
    for (std::size_t f = 0; f < label.size(); ++f) {
      const std::int32_t to = better_region(graph, label, f);
      if (to == label[f] || size[label[f]] == 1 || misfit(graph, f, axes[to]) > 0.8) continue;
      --size[label[f]];
      ++size[to];
      label[f] = to;
    }
}

/// The regions that are too wide get a second seed each, the face that differs most from their first one: a closed
/// region may have no mean normal to differ from.
std::vector<std::int32_t> split_wide(const FaceGraph& graph, const std::vector<std::int32_t>& label,
                                     const std::vector<Region>& regions, double spread) {
  std::vector<Vector3d> axes = axes_of(regions);
  std::vector<std::int32_t> seeds = extreme_faces(graph, label, axes, 1);
  std::vector<Vector3d> seed_normals;
  for (const std::int32_t f : seeds) seed_normals.push_back(graph.normal[f]);
  const std::vector<std::int32_t> worst = extreme_faces(graph, label, seed_normals, -1);
  const std::size_t before = seeds.size();
  for (std::size_t r = 0; r < before; ++r) {
    if (regions[r].spread() <= spread || worst[r] == seeds[r]) continue;
    seeds.push_back(worst[r]);
    axes.push_back(graph.normal[worst[r]]);
  }
  return seeds.size() == before ? label : Growth(graph).grow(seeds, axes);
}

/// The face that takes the most steps to reach.
std::int32_t farthest(const FaceGraph& graph, std::int32_t from) {
  std::vector<std::int32_t> order{from};
  std::vector<char> seen(graph.size(), 0);
  seen[from] = 1;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t l = graph.start[order[k]]; l < graph.start[order[k] + 1]; ++l)
      if (!std::exchange(seen[graph.links[l].face], 1)) order.push_back(graph.links[l].face);
  return order.back();
}

/// Normals that differ by less say nothing of where to cut.
constexpr double flat_spread = 1e-6;

}  // namespace

FaceGraph face_graph(const LinkedFaces& faces, const Chart& chart) {
  FaceGraph graph;
  for (std::size_t t = 0; t < chart.source.size(); ++t) {
    const bool first = t == 0 || faces.whole[chart.source[t]] != faces.whole[chart.source[t - 1]];
    if (first) {
      graph.normal.push_back(Vector3d::Zero());
      graph.area.push_back(1e-30);
    }
    graph.of_triangle.push_back(static_cast<std::int32_t>(graph.size()) - 1);
    const Triangle& v = faces.triangles[chart.source[t]];
    const Vector3d twice = (at(faces, v[1]) - at(faces, v[0])).cross(at(faces, v[2]) - at(faces, v[0]));
    graph.normal.back() += twice;
    graph.area.back() += twice.norm() / 2;
  }
  for (Vector3d& n : graph.normal) n.normalize();
  std::int32_t face = 0;
  for (std::size_t h = 0; h < chart.twin.size(); ++h) {
    while (face < graph.of_triangle[h / 3]) {
      graph.start.push_back(graph.links.size());
      ++face;
    }
    if (chart.twin[h] < 0 || graph.of_triangle[chart.twin[h] / 3] == face) continue;
    const Triangle& v = faces.triangles[chart.source[h / 3]];
    const double length = (at(faces, v[(h + 1) % 3]) - at(faces, v[h % 3])).norm();
    graph.links.push_back({graph.of_triangle[chart.twin[h] / 3], length});
  }
  graph.start.push_back(graph.links.size());
  return graph;
}

std::vector<std::int32_t> flat_regions(const FaceGraph& graph, double spread) {
  std::size_t count = 0;
  std::vector<std::int32_t> label = pieces(graph, {}, &count);
  while (true) {
    const std::vector<std::int32_t> next = split_wide(graph, label, regions_of(graph, label, count), spread);
    const auto grown = static_cast<std::size_t>(*std::ranges::max_element(next)) + 1;
    if (grown == count) break;
    count = grown;
    label = relaxed(graph, next, count, 2);
  }
  label = relaxed(graph, std::move(label), count, 3);
  smooth_borders(graph, label, count);
  return pieces(graph, label);
}

std::vector<std::int32_t> far_halves(const FaceGraph& graph) {
  const std::int32_t first = farthest(graph, 0), second = farthest(graph, first);
  std::vector<std::int32_t> label = Growth(graph).grow({first, second}, {Vector3d::Zero(), Vector3d::Zero()});
  smooth_borders(graph, label, 2);
  return pieces(graph, label);
}

std::vector<std::int32_t> halves(const FaceGraph& graph) {
  std::vector<std::int32_t> label(graph.size(), 0);
  const std::vector<Region> whole = regions_of(graph, label, 1);
  if (whole[0].spread() < flat_spread) return far_halves(graph);
  const std::int32_t first = extreme_faces(graph, label, axes_of(whole), -1)[0];
  const std::int32_t second = extreme_faces(graph, label, {graph.normal[first]}, -1)[0];
  const std::int32_t other = second != first ? second : (first == 0 ? 1 : 0);
  label = Growth(graph).grow({first, other}, {graph.normal[first], graph.normal[other]});
  label = relaxed(graph, std::move(label), 2, 4);
  smooth_borders(graph, label, 2);
  return pieces(graph, label);
}

}  // namespace pelage
