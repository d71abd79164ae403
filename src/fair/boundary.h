#pragma once
// Boundaries of a mesh as rails: their vertices slide along them and do not leave them.

#include <vector>

#include "shape/topology.h"

namespace pelage {

class BoundaryRails {
 public:
  /// The boundary as it runs through these points.
  BoundaryRails(const Topology& topology, const std::vector<Point>& points);

  /// Per vertex: lies at a corner of the boundary, where it turns by more than 35 degrees; it may not slide.
  const std::vector<char>& corner() const { return corner_; }

  /// Moves every boundary vertex to the nearest point of its rail: from the middle of one of its two boundary edges to
  /// the middle of the other, so that neighbours cannot pass each other.
  void put_back(std::vector<Point>& points) const;

 private:
  struct Rail {
    Index vertex;
    Point from, at, to;  ///< middle of the edge before, the vertex itself, middle of the edge after
  };
  std::vector<Rail> rails_;
  std::vector<char> corner_;
};

/// Per vertex whether it lies on the boundary.
std::vector<char> boundary_vertices(const Topology& topology);

}  // namespace pelage
