#pragma once
// From fields on a surface to a mesh with colours: samples on the limit surface become colours, normals and attributes.

#include <string>
#include <vector>

#include "pelage/recipe.h"
#include "pelage/triangle_mesh.h"
#include "shape/texture.h"

namespace pelage {

/// Fields as a run leaves them.
struct CoatFields {
  TriangleMesh shape;             ///< the mesh that the user gave, repaired
  std::vector<Texture> textures;  ///< that layers may read
  int levels = 0;                 ///< how often it was refined for the run
  bool loop = true;               ///< by Loop's rules, or at midpoints
  std::vector<Point> control;     ///< control points of the refined mesh
  std::vector<std::string> species;
  std::vector<std::vector<double>> coefficients;  ///< per species, one for every control point
  double wavelength = 0;                          ///< of the pattern [world units]
};

/// The surface, tessellated, with "normal" (unit), "color" (linear light), one attribute per species, and the vertex
/// and corner attributes of the shape, interpolated linearly in every triangle (its "color" becomes "input_color").
/// Either the limit surface, or with look.keep_shape the flat triangles of the shape with its vertices first and
/// unmoved, every point coloured from the point of the limit surface with the same barycentric coordinates.
/// Error(Fault::usage) for an unknown species or ramp, or a detail that needs more than 30 million triangles.
TriangleMesh dress(CoatFields fields, const Look& look);

}  // namespace pelage
