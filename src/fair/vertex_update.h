#pragma once
// Vertices follow the normals of their faces.

#include "fair/faces.h"

namespace pelage {

/// Moves every vertex towards the planes through the centroids of its faces with the given normals (Sun, Rosin, Martin,
/// Langbein 2007, eq. 8): the mean of the distances, along the normals. `fixed` vertices stay.
void follow_normals(const Topology& topology, const FaceLists& faces_of_vertex, const std::vector<Vector3>& normal,
                    const std::vector<char>& fixed, int rounds, std::vector<Point>& points);

/// Turns triangles that are folded over back, and keeps others from folding.
class Unfolding {
 public:
  /// Remembers the shapes that the triangles have now.
  Unfolding(const Topology& topology, const std::vector<Point>& points);

  /// Moves the vertices of faces that lean away from their given normal, and of those that have become needles since,
  /// towards the mean of their neighbours, within the tangent plane. The first have been turned over by noise along the
  /// surface; the second are about to be, because their normal is that of so little area that nothing holds it. Returns
  /// how many vertices belonged to such faces in the last round.
  std::size_t apply(const FaceLists& faces_of_vertex, const std::vector<Vector3>& normal,
                    const std::vector<char>& fixed, int rounds, std::vector<Point>& points) const;

 private:
  std::vector<char> marked_vertices(const FaceGeometry& faces, const std::vector<Vector3>& normal,
                                    const std::vector<Point>& points) const;

  const Topology& topology_;
  std::vector<double> first_shape_;
};

}  // namespace pelage
