#pragma once
// What a pattern on a surface is like, in numbers.

#include <array>
#include <optional>
#include <vector>

#include "measure/spectrum.h"
#include "measure/spots.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// Where a function is above a level, or below it.
struct PatternPhase {
  std::size_t parts = 0;  ///< that are connected
  double share = 0;       ///< of the area
  double width = 0;  ///< twice its area over the length of its border: of stripes their width, of discs half of their
                     ///< diameter; 0 without a border [world units]
};

/// Places where the lines across the slopes have no direction, in half turns: +1/2 where stripes end or bend around,
/// -1/2 where three meet. On a closed surface half of `plus` - `minus` is its Euler characteristic. Of spots there are
/// as many as there are spots.
struct StripeDefects {
  std::size_t plus = 0, minus = 0;
};

struct PatternMeasures {
  double area = 0;  ///< of the surface [world units^2], or the volume (measure_nodes) [world units^3]
  double minimum = 0, maximum = 0, mean = 0, deviation = 0;  ///< the last two weighted with the area
  double level = 0;
  PatternPhase above, below;
  double border = 0;  ///< length of the lines at the level [world units]
  /// 2 pi over the root mean square wave number, (integral of |grad u|^2 / integral of (u - mean)^2)^(1/2): the
  /// wavelength of a plane wave; less where edges are sharp. 0 for a constant [world units].
  double wavelength = 0;
  /// Of the phase with more parts: the distance of neighbours if they were laid in triangles, (2 area / (3^(1/2)
  /// parts))^(1/2) [world units].
  double spacing = 0;
  /// (a - b) / (a + b) with the larger and the smaller mean square slope across and along, in the means over Gaussians
  /// with half a wavelength for their sigma: 1 for straight stripes, 0 for spots.
  double coherence = 0;
  /// Mean squares of the coordinates of the unit vectors along the stripes, weighted with slopes and coherence; their
  /// sum is 1 where there are any.
  std::array<double, 3> along{};
  StripeDefects defects;
  Spots spots;        ///< of the phase with more parts
  Spectrum spectrum;  ///< empty for a constant
};

/// Halfway between the lowest and the highest half percent of the values, of which there are some.
double middle_level(std::vector<double> values);

/// Of a function that is linear on the triangles, with one value per vertex. Default level: middle_level.
/// Error(Fault::input) for meshes without area, or that are no manifold.
PatternMeasures measure_pattern(const TriangleMesh& mesh, const std::vector<double>& values,
                                const std::optional<double>& level = {});

}  // namespace pelage
