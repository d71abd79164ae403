#pragma once
// Triangles that are split where their edges are long, so that neighbours still fit.

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Splits all edges longer than `longest` at their middles and the triangles at them into two, three or four. Vertices
/// keep their numbers, middles follow in the order of their edges' ends. Values at vertices and corners are linear in
/// between, those of faces are inherited. The triangles need not fit together otherwise. Whether there were any.
bool split_edges(TriangleMesh& mesh, double longest);

/// The same until no edge is longer, or there would be more than about `most_triangles`; of thin ones up to five times
/// as many.
void split_long_edges(TriangleMesh& mesh, double longest, std::size_t most_triangles);

}  // namespace pelage
