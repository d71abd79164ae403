#pragma once
// Atlases: texture coordinates for meshes that have none, or that want better ones.
//
//   pelage::PolygonMesh mesh = pelage::polygons_of(pelage::load_shape("cow.obj"));
//   mesh.set(pelage::unwrap(mesh).uv);
//   pelage::save(mesh, "cow_uv.obj");
//
// All errors are pelage::Error, see error.h.

#include <cstdint>
#include <vector>

#include "pelage/finding.h"
#include "pelage/polygon_mesh.h"
#include "pelage/progress.h"

namespace pelage {

struct UnwrapOptions {
  int resolution = 2048;  ///< of the square image for which margins count, in texels
  double margin = 4;      ///< between charts, in texels; half of it at the borders of the image
};

/// For square images of that size: with margins as wide as small ones need.
UnwrapOptions atlas_options(int size);

struct UnwrapReport {
  std::size_t charts = 0;
  double stretch = 1;        ///< L2 stretch (Sander, Snyder, Gortler, Hoppe 2001); 1 is an isometry
  double worst_stretch = 1;  ///< the largest of a chart
  double efficiency = 0;     ///< share of the unit square that charts cover
  double scale = 0;          ///< length in uv of a unit of the mesh: the square root of area in uv by area in space
};

struct Unwrapped {
  Attribute uv;                     ///< "uv", per corner, in [0, 1]
  std::vector<std::int32_t> chart;  ///< per face: its chart, -1 for faces that have none
  UnwrapReport report;
  std::vector<Finding> findings;
};

/// Cuts a surface along edges of its faces into charts, each a disc, and lays these side by side into the unit square.
/// No triangle is turned over, no two overlap, and all have about the same area in uv per area in space. Any faces will
/// do: boundaries, edges of more than two faces and edges where the orientation changes become borders of charts; what
/// touches at equal places hangs together, though the vertices differ. Deterministic for any number of threads.
/// Error(Fault::input) for a mesh without faces, or with vertex numbers or places that are none; Error(Fault::usage)
/// for margins that leave no room; Error(Fault::cancelled).
Unwrapped unwrap(const PolygonMesh& mesh, const UnwrapOptions& options = {}, const Progress& progress = {});

}  // namespace pelage
