#include "unwrap/chart.h"

#include <algorithm>
#include <numeric>

#include "shape/edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::vector<std::int32_t> own_twins(const LinkedFaces& faces, const std::vector<std::int32_t>& source,
                                    const Joined& joined) {
  std::vector<std::int32_t> twin(3 * source.size(), -1);
  for (std::size_t h = 0; h < twin.size(); ++h) {
    const std::int32_t halfedge = 3 * source[h / 3] + static_cast<std::int32_t>(h % 3), other = faces.twin[halfedge];
    if (other < 0) continue;
    const auto found = std::ranges::lower_bound(source, other / 3);
    if (found == source.end() || *found != other / 3 || !joined(halfedge)) continue;
    twin[h] = static_cast<std::int32_t>(3 * (found - source.begin()) + other % 3);
  }
  return twin;
}

/// Corners that are one vertex have one representative.
class Corners {
 public:
  explicit Corners(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t c) {
    while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
    return c;
  }
  void unite(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::int32_t> parent_;
};

void number_vertices(const LinkedFaces& faces, Chart& chart) {
  Corners corners(chart.twin.size());
  for (std::int32_t h = 0; h < std::ssize(chart.twin); ++h) {
    if (chart.twin[h] < 0) continue;
    corners.unite(h, next_in_face(chart.twin[h]));
    corners.unite(next_in_face(h), chart.twin[h]);
  }
  std::vector<std::int32_t> number(chart.twin.size(), -1);
  for (std::int32_t c = 0; c < std::ssize(number); ++c) {
    const std::int32_t first = corners.find(c);
    if (first == c) {
      number[c] = static_cast<std::int32_t>(chart.place.size());
      chart.place.push_back(faces.triangles[chart.source[c / 3]][c % 3]);
    }
    chart.triangles[c / 3][c % 3] = number[first];
  }
}

double area_of(const LinkedFaces& faces, const Chart& chart) {
  double area = 0;
  for (const std::int32_t t : chart.source) {
    const Triangle& v = faces.triangles[t];
    area += length(cross(difference(faces.points[v[1]], faces.points[v[0]]),
                         difference(faces.points[v[2]], faces.points[v[0]]))) /
            2;
  }
  return area;
}

}  // namespace

Chart make_chart(const LinkedFaces& faces, std::vector<std::int32_t> source, const Joined& joined) {
  Chart chart;
  chart.source = std::move(source);
  chart.triangles.resize(chart.source.size());
  chart.twin = own_twins(faces, chart.source, joined);
  number_vertices(faces, chart);
  chart.area = area_of(faces, chart);
  return chart;
}

bool is_disc(const Chart& chart) {
  const auto inner = chart.twin.size() - static_cast<std::size_t>(std::ranges::count(chart.twin, -1));
  const std::ptrdiff_t edges = std::ssize(chart.twin) - static_cast<std::ptrdiff_t>(inner / 2);
  return std::ssize(chart.place) - edges + std::ssize(chart.triangles) == 1 &&
         border_of(chart).size() + inner == chart.twin.size();
}

std::int32_t next_on_border(const std::vector<std::int32_t>& twin, std::int32_t halfedge) {
  std::int32_t h = next_in_face(halfedge);
  while (twin[h] >= 0) h = next_in_face(twin[h]);
  return h;
}

std::vector<std::int32_t> border_of(const Chart& chart) {
  std::vector<std::int32_t> border;
  const auto first = static_cast<std::int32_t>(std::ranges::find(chart.twin, -1) - chart.twin.begin());
  if (first == std::ssize(chart.twin)) return border;
  for (std::int32_t h = first; border.empty() || h != first; h = next_on_border(chart.twin, h)) border.push_back(h);
  return border;
}

}  // namespace pelage
