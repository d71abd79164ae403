#pragma once
// A surface and the fields on it at any place: where texels, points of print and neighbouring meshes lie.

#include <memory>
#include <vector>

#include "discretise/space.h"

namespace pelage {

/// One place.
struct SurfaceSample {
  Point position{};              ///< world units
  Point normal{};                ///< unit length; 0 where the surface degenerates
  std::vector<double> values;    ///< per field
  std::vector<Point> gradients;  ///< per field, tangent to the surface [1 / world unit]
};

class SurfaceEvaluator {
 public:
  /// `levels`: how often the triangles of the shape were split into four for the space; `coefficients`: per field, one
  /// for every unknown.
  SurfaceEvaluator(std::shared_ptr<const Space> space, int levels, std::vector<std::vector<double>> coefficients);

  /// At (1-v-w) a + v b + w c of the triangle `face` = (a, b, c) of the shape, 0 <= v, w and v + w <= 1. Thread-safe.
  SurfaceSample at(Index face, double v, double w) const;

 private:
  std::shared_ptr<const Space> space_;
  int levels_;
  std::vector<std::vector<double>> coefficients_;
};

}  // namespace pelage
