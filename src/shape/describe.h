#pragma once
// What a mesh is, in numbers.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/finding.h"

namespace pelage {

/// Smallest, mean and largest of a quantity.
struct Spread {
  double min = 0, mean = 0, max = 0;
};

struct MeshReport {
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t components = 0;      ///< pieces connected through edges
  std::size_t boundary_loops = 0;  ///< closed chains of edges with one face
  std::size_t boundary_edges = 0;
  long euler_characteristic = 0;        ///< vertices - edges + faces
  long genus = 0;                       ///< handles, summed over the components
  std::map<int, std::size_t> valences;  ///< number of edges at a vertex -> how many such vertices
  Spread edge_length;                   ///< world units
  Spread angle;                         ///< corners of the triangles, degrees
  double area = 0;                      ///< world units squared
  double volume = 0;                    ///< enclosed by the closed components, world units cubed; 0 if there is none
  bool closed = false;                  ///< no boundary at all
  Point low{}, high{};                  ///< bounding box
  double diagonal = 0;                  ///< of the bounding box
  std::vector<std::string> attributes;  ///< "uv (2 per corner)", "color (3 per vertex)", ...
  std::vector<Finding> findings;        ///< what the checks said
};

/// Describes a mesh as repair() leaves it: manifold, oriented, every vertex used. `findings` go into the report:
/// those that came with the mesh, or, left out, those of repair() on a copy.
MeshReport describe(const TriangleMesh& mesh, std::vector<Finding> findings);
MeshReport describe(const TriangleMesh& mesh);

}  // namespace pelage
