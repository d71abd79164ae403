#pragma once
// Triangles as samples of a surface: their geometry, and which ones lie near each other.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shape/topology.h"

namespace pelage {

using Vector3 = Eigen::Vector3d;

inline Vector3 vector3(const Point& p) { return {p[0], p[1], p[2]}; }

struct FaceGeometry {
  std::vector<Vector3> normal;  ///< unit length; 0 for a triangle without area
  std::vector<Vector3> centroid;
  std::vector<double> area;
};
FaceGeometry face_geometry(const std::vector<Triangle>& triangles, const std::vector<Point>& points);

/// At every vertex the area-weighted mean of one vector per face, of unit length; 0 where it vanishes.
std::vector<Vector3> vertex_means(const Topology& topology, const std::vector<Vector3>& per_face,
                                  const std::vector<double>& area);

/// A list of faces for every vertex or face, one after the other.
struct FaceLists {
  std::vector<std::int64_t> start{0};
  std::vector<Index> face;

  std::size_t size() const { return start.size() - 1; }
  std::span<const Index> operator[](std::size_t i) const {
    return {face.data() + start[i], face.data() + start[i + 1]};
  }
};

/// The faces around every vertex, ascending.
FaceLists faces_of_vertices(const Topology& topology);

/// The faces that share a vertex with each face, itself included, ascending. Of a vertex with very many faces only the
/// nearest ones around it count.
FaceLists neighbours(const Topology& topology, const FaceLists& faces_of_vertex);

/// For every face the faces that are reached through neighbours whose centroids lie within radius[f] of its own, in
/// the order of the search, itself first; at most 256.
FaceLists discs(const FaceLists& neighbour, const std::vector<Vector3>& centroid, const std::vector<double>& radius);

/// Local distance between the centroids of faces that share an edge, averaged over `rounds` rings of neighbours.
std::vector<double> centroid_spacing(const Topology& topology, const FaceLists& neighbour,
                                     const std::vector<Vector3>& centroid, int rounds);

/// The squared way from `from` to `points` along the normals there, at every vertex that is not fixed; 0 elsewhere.
std::vector<double> squared_ways(const std::vector<Triangle>& triangles, const std::vector<char>& fixed,
                                 const std::vector<Point>& from, const std::vector<Point>& points);

/// Mean length of the edges.
double mean_edge(const Topology& topology, const std::vector<Point>& points);

}  // namespace pelage
