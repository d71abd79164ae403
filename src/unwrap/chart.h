#pragma once
// A piece of a surface that is laid into the plane.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "unwrap/linked_faces.h"

namespace pelage {

using Flat = std::array<double, 2>;

/// Triangles that hang together; vertices are the chart's own, several at one place along a seam.
struct Chart {
  std::vector<std::int32_t> source;  ///< numbers in LinkedFaces, ascending
  std::vector<Triangle> triangles;   ///< of own vertices
  std::vector<std::int32_t> twin;    ///< per own half-edge; -1 at the border
  std::vector<std::int32_t> place;   ///< per vertex, in LinkedFaces
  std::vector<Flat> uv;              ///< per vertex: once it is flattened, in the unit of the points
  double area = 0;                   ///< in space
  double stretch = 0;                ///< once it is flattened: see stretch.h
};

/// Whether the triangles on both sides of a half-edge, which are in the chart, hang together there.
using Joined = std::function<bool(std::int32_t halfedge)>;

Chart make_chart(const LinkedFaces& faces, std::vector<std::int32_t> source, const Joined& joined);

bool is_disc(const Chart& chart);

/// The border half-edge that follows one; for twins as in Chart.
std::int32_t next_on_border(const std::vector<std::int32_t>& twin, std::int32_t halfedge);

/// Half-edges of the border of a disc in their order; of other charts those of one loop, if there is any.
std::vector<std::int32_t> border_of(const Chart& chart);

}  // namespace pelage
