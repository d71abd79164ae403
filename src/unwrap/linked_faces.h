#pragma once
// The faces of a file as triangles that know their neighbours: what is unwrapped.

#include <cstdint>
#include <vector>

#include "pelage/polygon_mesh.h"
#include "shape/finding.h"

namespace pelage {

/// Half-edge 3*t + k runs from corner k of triangle t to the next one.
struct LinkedFaces {
  std::vector<Point> points;         ///< those of the file times a power of two, so that their box is about 1 wide
  std::vector<Triangle> triangles;   ///< corners are places: the first point there; no two of a triangle are the same
  std::vector<std::int32_t> corner;  ///< per corner of a triangle: the corner of the file
  std::vector<std::int32_t> face;    ///< per triangle: the face of the file; ascending
  std::vector<std::int32_t> whole;   ///< per triangle: what is never cut; a face, or a triangle of one that is no disc
  std::vector<std::int32_t> twin;    ///< per half-edge: the opposite one; -1 at boundaries, where more than two faces
                                     ///< meet, and where the other face is turned the other way
  std::vector<std::int32_t> place;   ///< per point of the file
  double scale = 1;                  ///< the power of two
};

/// Faces with all corners on one line stay in with a finding; what has no two places that differ is left out. Faces are
/// linked across equal places, not only equal vertices. Error(Fault::input) where there are no faces to unwrap.
LinkedFaces link_faces(const PolygonMesh& polygons, std::vector<Finding>& findings);

}  // namespace pelage
