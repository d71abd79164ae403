#pragma once
// Filtering of face normals that keeps edges: a joint bilateral filter with guidance normals (Zhang, Deng, Zhang,
// Bouaziz, Liu 2015), changed in four ways that each lowered the error on flat, round and sharp shapes alike:
//  - the guidance of a face is a weighted mean over all patches that contain it, not that of the one most consistent
//    patch, whose choice is a matter of luck where nothing is sharp;
//  - normals are fitted by a linear function around each face, not a constant, so that curved parts keep their
//  curvature;
//  - the range of normals that count as near follows the noise that is left in the guidance;
//  - neighbourhoods scale with the local size of the faces.

#include "fair/faces.h"

namespace pelage {

class NormalFilter {
 public:
  /// Neighbourhoods are those of the given points and stay.
  NormalFilter(const Topology& topology, const std::vector<Point>& points);

  /// The filtered unit normals of the faces.
  std::vector<Vector3> filter(const FaceGeometry& faces);

  /// |n - n'| at which the last call let the weight fall to exp(-1/2).
  double range() const { return range_; }

 private:
  void rate_patches(const FaceGeometry& faces);
  void make_guidance();
  double guidance_range() const;
  Vector3 fit(const FaceGeometry& faces, std::size_t f) const;

  const Topology& topology_;
  FaceLists neighbour_, disc_;
  std::vector<double> spacing_;
  std::vector<double> roughness_;  ///< per face: of the patch around it, 0 if all its normals are equal
  std::vector<Vector3> patch_normal_, guidance_;
  double range_ = 0;
};

}  // namespace pelage
