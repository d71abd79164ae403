#pragma once
// Linear elements on the flat triangles of a mesh, as one writes them in an afternoon: cotangent stiffness, lumped
// mass.

#include <vector>

#include "pelage/triangle_mesh.h"

namespace plain {

/// Row i has the entries begin[i] to begin[i + 1] - 1, in ascending order of their columns.
struct Elements {
  std::vector<int> begin, column;
  std::vector<double> stiffness;  ///< K: integral of grad phi_i . grad phi_j, one per entry
  std::vector<double> mass;       ///< of row i: a third of the area of its triangles

  int size() const { return static_cast<int>(mass.size()); }
};

Elements assemble(const pelage::TriangleMesh& mesh);

/// The largest eigenvalue of M^-1 K from below, within about a percent: power iteration.
double spectral_radius(const Elements& elements);

/// Vertices in the order in which a wave from the first one meets them, so that neighbours are near in memory:
/// order[new number] = number in the mesh.
std::vector<int> breadth_first(const pelage::TriangleMesh& mesh);

/// Points and triangles of the mesh, without attributes, in that order.
pelage::TriangleMesh renumbered(const pelage::TriangleMesh& mesh, const std::vector<int>& order);

}  // namespace plain
