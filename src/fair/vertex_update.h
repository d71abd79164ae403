#pragma once
// Vertices follow the normals of their faces.

#include "fair/faces.h"

namespace pelage {

/// Moves every vertex towards the planes through the centroids of its faces with the given normals (Sun, Rosin, Martin,
/// Langbein 2007, eq. 8): the mean of the distances, along the normals. `fixed` vertices stay.
void follow_normals(const Topology& topology, const FaceLists& faces_of_vertex, const std::vector<Vector3>& normal,
                    const std::vector<char>& fixed, int rounds, std::vector<Point>& points);

/// Moves the vertices of faces that lean away from their given normal towards the mean of their neighbours, within the
/// tangent plane: this unfolds triangles that noise along the surface has turned over. Returns how many vertices
/// belonged to such faces in the last round.
std::size_t unfold(const Topology& topology, const FaceLists& faces_of_vertex, const std::vector<Vector3>& normal,
                   const std::vector<char>& fixed, int rounds, std::vector<Point>& points);

}  // namespace pelage
