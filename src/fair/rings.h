#pragma once
// Vertices near a vertex.

#include <vector>

#include "shape/topology.h"

namespace pelage {

/// Finds the free vertices of two rings around a vertex.
class TwoRings {
 public:
  /// Refers to both.
  TwoRings(const Topology& topology, const std::vector<char>& fixed);

  /// Those around v and, free or not, v itself, each once, ascending.
  void around(Index v, std::vector<Index>& near) const;

 private:
  const Topology& topology_;
  const std::vector<char>& fixed_;
  std::vector<std::int32_t> faces_;  ///< around each vertex
};

}  // namespace pelage
