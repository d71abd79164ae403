#include "fair/faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "shape/normals.h"

namespace pelage {

namespace {

/// Concatenates lists that are made in parallel, one per index.
template <class MakeList>
FaceLists collect(std::size_t count, MakeList&& make_list) {
  std::vector<std::vector<Index>> list(count);
  parallel_for(
      count,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) make_list(i, list[i]);
      },
      256);
  FaceLists result;
  for (const auto& l : list) {
    result.face.insert(result.face.end(), l.begin(), l.end());
    result.start.push_back(static_cast<std::int64_t>(result.face.size()));
  }
  return result;
}

/// Around a vertex of more faces than this, those of its faces that are at most `reach` edges away count as near. With
/// all of them the work would grow with the third power of their number.
constexpr std::size_t many_around = 64;
constexpr int reach = 16;

/// A disc has about ten faces where they are even, and no more than this where the mesh changes from large to very
/// small ones: those that are found first, which are the nearest in edges. The work grows with the square.
constexpr std::size_t most_in_disc = 256;

/// The faces near f around its corner k.
void append_near(const Topology& topology, std::size_t f, int k, std::vector<Index>& list) {
  const auto first = static_cast<Index>(3 * f);
  Index out = first + k, in = first + (k + 2) % 3;  // half-edges of the face, from the vertex and to it
  for (int step = 0; step < reach && (in >= 0 || out >= 0); ++step) {
    if (out >= 0) out = topology.twin[out];
    if (in >= 0) in = topology.twin[in];
    for (const Index h : {out, in})
      if (h >= 0) list.push_back(h / 3);
    if (out >= 0) out = next_halfedge(out);
    if (in >= 0) in = previous_halfedge(in);
  }
}

/// The faces of one disc: four times as many places as there may be faces, each face in the first free one after its
/// number.
class DiscMembers {
 public:
  DiscMembers() { place_.fill(-1); }

  /// False if it is one already.
  bool add(Index face) {
    std::size_t at = static_cast<std::size_t>(face) % place_.size();
    for (; place_[at] >= 0; at = (at + 1) % place_.size())
      if (place_[at] == face) return false;
    place_[at] = face;
    return true;
  }

 private:
  std::array<Index, 4 * most_in_disc> place_;
};

}  // namespace

FaceGeometry face_geometry(const std::vector<Triangle>& triangles, const std::vector<Point>& points) {
  FaceGeometry g;
  g.normal.resize(triangles.size());
  g.centroid.resize(triangles.size());
  g.area.resize(triangles.size());
  parallel_for(triangles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const auto& [i, j, k] = triangles[f];
      const Vector3 a = vector3(points[i]), b = vector3(points[j]), c = vector3(points[k]);
      const Vector3 n = (b - a).cross(c - a);
      const double length = n.norm();
      g.normal[f] = length > 0 ? Vector3(n / length) : Vector3::Zero();
      g.centroid[f] = (a + b + c) / 3;
      g.area[f] = length / 2;
    }
  });
  return g;
}

std::vector<Vector3> vertex_means(const Topology& topology, const std::vector<Vector3>& per_face,
                                  const std::vector<double>& area) {
  std::vector<Vector3> mean(topology.vertex_count, Vector3::Zero());
  for (std::size_t f = 0; f < per_face.size(); ++f)
    for (Index v : topology.triangles[f]) mean[v] += area[f] * per_face[f];
  for (Vector3& m : mean) m = m.norm() > 0 ? m.normalized().eval() : Vector3::Zero();
  return mean;
}

FaceLists faces_of_vertices(const Topology& topology) {
  FaceLists lists;
  std::vector<std::int64_t> count(topology.vertex_count, 0);
  for (const Triangle& t : topology.triangles)
    for (Index v : t) ++count[v];
  for (std::int64_t c : count) lists.start.push_back(lists.start.back() + c);
  lists.face.resize(lists.start.back());
  std::vector<std::int64_t> next(lists.start.begin(), lists.start.end() - 1);
  for (std::size_t f = 0; f < topology.triangles.size(); ++f)
    for (Index v : topology.triangles[f]) lists.face[next[v]++] = static_cast<Index>(f);
  return lists;
}

FaceLists neighbours(const Topology& topology, const FaceLists& faces_of_vertex) {
  return collect(topology.triangles.size(), [&](std::size_t f, std::vector<Index>& list) {
    list.push_back(static_cast<Index>(f));
    for (int k = 0; k < 3; ++k) {
      const auto around = faces_of_vertex[topology.triangles[f][k]];
      if (around.size() > many_around)
        append_near(topology, f, k, list);
      else
        list.insert(list.end(), around.begin(), around.end());
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  });
}

FaceLists discs(const FaceLists& neighbour, const std::vector<Vector3>& centroid, const std::vector<double>& radius) {
  return collect(neighbour.size(), [&](std::size_t f, std::vector<Index>& list) {
    DiscMembers members;
    list.push_back(static_cast<Index>(f));
    members.add(list[0]);
    for (std::size_t k = 0; k < list.size(); ++k)
      for (Index g : neighbour[list[k]]) {
        if (list.size() == most_in_disc) return;
        if ((centroid[g] - centroid[f]).norm() <= radius[f] && members.add(g)) list.push_back(g);
      }
  });
}

std::vector<double> centroid_spacing(const Topology& topology, const FaceLists& neighbour,
                                     const std::vector<Vector3>& centroid, int rounds) {
  std::vector<double> spacing(centroid.size(), 0.0), next(centroid.size());
  for (std::size_t f = 0; f < centroid.size(); ++f) {
    int sides = 0;
    for (Index h = static_cast<Index>(3 * f); h < static_cast<Index>(3 * f + 3); ++h) {
      if (topology.twin[h] < 0) continue;
      spacing[f] += (centroid[topology.twin[h] / 3] - centroid[f]).norm();
      ++sides;
    }
    if (sides > 0) spacing[f] /= sides;
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t f = 0; f < spacing.size(); ++f) {
      double sum = 0;
      for (Index g : neighbour[f]) sum += spacing[g];
      next[f] = sum / static_cast<double>(neighbour[f].size());
    }
    std::swap(spacing, next);
  }
  return spacing;
}

std::vector<double> squared_ways(const std::vector<Triangle>& triangles, const std::vector<char>& fixed,
                                 const std::vector<Point>& from, const std::vector<Point>& points) {
  const std::vector<Point> normal = vertex_normals(triangles, points);
  std::vector<double> square(points.size(), 0);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (fixed[v]) continue;
    const double way = vector3(normal[v]).dot(vector3(points[v]) - vector3(from[v]));
    square[v] = way * way;
  }
  return square;
}

double mean_edge(const Topology& topology, const std::vector<Point>& points) {
  double sum = 0;
  for (Index h = 0; h < static_cast<Index>(topology.twin.size()); ++h)
    if (topology.twin[h] < h)  // each edge once
      sum += (vector3(points[topology.origin(h)]) - vector3(points[topology.target(h)])).norm();
  return topology.edge_count > 0 ? sum / topology.edge_count : 0;
}

}  // namespace pelage
