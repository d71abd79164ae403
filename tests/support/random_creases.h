#pragma once
// Creases here and there: ends, lines and corners of every kind.

#include "base/random.h"
#include "shape/creases.h"

namespace pelage::testing {

/// So many of the edges are sharp.
inline Creases random_creases(const Topology& topology, double share) {
  Topology t = topology;
  t.creases = {std::vector<char>(static_cast<std::size_t>(t.edge_count)),
               std::vector<char>(static_cast<std::size_t>(t.vertex_count))};
  for (std::size_t e = 0; e < t.creases.edge.size(); ++e) t.creases.edge[e] = uniform(5, e) < share;
  VertexRing around;
  for (Index v = 0; v < t.vertex_count; ++v) {
    vertex_ring(t, v, around);
    t.creases.corner[static_cast<std::size_t>(v)] = around.sharp.size() > 2;
  }
  return t.creases;
}

}  // namespace pelage::testing
