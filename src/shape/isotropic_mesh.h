#pragma once
// A mesh of nearly equilateral triangles of wanted size on a given surface.

#include <vector>

#include "pelage/progress.h"
#include "shape/hierarchy.h"
#include "shape/mesh_place.h"

namespace pelage {

struct IsotropicMesh {
  Topology topology;              ///< triangles in the order of their smallest vertex
  std::vector<Point> points;      ///< neighbours have near numbers
  std::vector<MeshPlace> places;  ///< of the points, on the triangles of the base
};

/// The same surface with edges of about `edge`: area * 2 / (sqrt(3) edge^2) vertices, nearly all of valence 5 to 7.
/// Edges are cut, collapsed and turned, vertices move to the middle of their surroundings (Botsch, Kobbelt 2004, "A
/// remeshing approach to multiresolution modeling", section 4), always on the flat triangles of the base.
///
/// The base must be an oriented manifold; it may have boundaries and several components and be uneven. Components,
/// holes and handles all stay, also those smaller than an edge. Boundary vertices stay on the boundary, and where it
/// turns by more than 40 degrees one stays in place. Edges where the new mesh bends by more than 60 degrees are kept
/// roughly; finer ones are not. The creases of the base are kept: vertices on them move along them, their corners and
/// ends stay, and the topology of the mesh has them, too. The result does not depend on the number of threads, nor, but
/// for rounding, on the order of the base's vertices and triangles, on where it lies and how large it is. Throws
/// Error(Fault::usage) unless all edges are positive, or for more than 100 million triangles.
IsotropicMesh isotropic_mesh(const std::vector<Triangle>& triangles, const std::vector<Point>& points, double edge);

/// The same with one edge length per base vertex, linear between. Lengths that grow by more than 0.3 per unit of length
/// along the surface are lowered.
IsotropicMesh isotropic_mesh(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                             const std::vector<double>& edges);

/// The same on the finest level of a hierarchy, where the points and edges are given. It begins with the triangles of
/// that level which has about as many as the result: fewer edges are to be cut or collapsed. Error(Fault::cancelled).
IsotropicMesh isotropic_mesh(const Hierarchy& levels, const std::vector<Point>& points, std::vector<double> edges,
                             const Progress& progress = {});

}  // namespace pelage
