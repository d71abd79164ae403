#pragma once
// Faces gathered into regions that are nearly flat: variational shape approximation (Cohen-Steiner, Alliez, Desbrun
// 2004) with as many regions as it takes, and borders that are short or follow creases.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "unwrap/chart.h"

namespace pelage {

/// Faces of a chart, which are what regions are made of.
struct FaceGraph {
  struct Link {
    std::int32_t face;
    double length;  ///< of the edge
  };
  std::vector<Eigen::Vector3d> normal;  ///< of length 1, or 0
  std::vector<double> area;             ///< above 0, if only by a trifle
  std::vector<std::size_t> start{0};    ///< of the links of a face
  std::vector<Link> links;
  std::vector<std::int32_t> of_triangle;  ///< per triangle of the chart

  std::size_t size() const { return area.size(); }
};
FaceGraph face_graph(const LinkedFaces& faces, const Chart& chart);

/// Per face a region from 0 on; regions hang together. More of them until the mean normal of each is longer than
/// 1 - `spread`: a cap whose rim leans by w has a mean of length (1 + cos w) / 2.
std::vector<std::int32_t> flat_regions(const FaceGraph& graph, double spread);

/// The same into two parts at least, for two faces at least that hang together: by their normals.
std::vector<std::int32_t> halves(const FaceGraph& graph);

/// And by how far it is to two faces that are far from each other, in faces.
std::vector<std::int32_t> far_halves(const FaceGraph& graph);

}  // namespace pelage
