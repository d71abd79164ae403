#pragma once
// Volumes of the closed components of a mesh.

#include <vector>

#include "shape/topology.h"

namespace pelage {

class ClosedParts {
 public:
  explicit ClosedParts(const Topology& topology);

  /// Sum over the closed components; what is open has none.
  double volume(const std::vector<Point>& points) const;
  /// Moves the vertices of every closed component along their normals, all by the same way, until it has the volume
  /// that it has in `before`.
  void restore_volumes(const std::vector<Point>& before, std::vector<Point>& points) const;

 private:
  std::vector<double> volumes(const std::vector<Point>& points) const;
  std::vector<double> areas(const std::vector<Point>& points) const;

  const Topology& topology_;
  std::vector<Index> part_;  ///< per vertex: number of its closed component, or -1
  std::size_t count_ = 0;
};

}  // namespace pelage
