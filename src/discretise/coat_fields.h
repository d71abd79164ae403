#pragma once
// Fields as a run leaves them.

#include <memory>
#include <string>
#include <vector>

#include "discretise/method.h"
#include "discretise/simulation_mesh.h"
#include "pelage/node_shape.h"
#include "pelage/triangle_mesh.h"
#include "shape/texture.h"

namespace pelage {

/// Of one moment of a run; what does not change is shared with it.
struct CoatFields {
  std::shared_ptr<const TriangleMesh> shape;   ///< the mesh that the user gave, repaired
  std::shared_ptr<const NodeShape> nodes;      ///< of which `shape` is the mesh, and there is no hierarchy, and for
                                               ///< grids no points and no control points; else null
  std::vector<Point> points;                   ///< where its vertices are now
  std::vector<Point> surface;                  ///< of a volume that has moved: where the vertices of the surface that
                                               ///< it fills are now; else empty
  std::vector<Texture> textures;               ///< that layers may read
  std::shared_ptr<const Hierarchy> hierarchy;  ///< of the shape; the fields live on its finest level, or on a
  std::shared_ptr<const SimulationMesh> mesh;  ///< mesh of their own (else null)
  const Method* method = nullptr;
  std::shared_ptr<const Space> space;
  std::vector<Point> control;                     ///< at the finest level
  std::vector<Point> initial_control;             ///< the same before the surface moved; empty if it has not
  std::vector<std::string> species;               ///< of earlier stages "STAGE.SPECIES"
  std::vector<std::vector<double>> coefficients;  ///< per species, one for every unknown of the space
  std::vector<char> uniform;                      ///< per species, whether it shows no pattern
  double wavelength = 0;                          ///< of the finest pattern [world units]
  double length_unit = 1;                         ///< world length of a model length unit of the last stage
  Point origin{};                                 ///< from where random fields of the last stage count
  Point period{};                                 ///< of its smooth ones; 0: none
  std::uint64_t seed = 1;                         ///< of the last stage
};

}  // namespace pelage
