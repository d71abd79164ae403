#pragma once
// What the pattern of a coat is like, in numbers.
//
//   const pelage::PatternMeasures m = pelage::measure(pelage::read_shape("coat.vtp"), "b");
//   std::cout << m.spots.count << " spots, " << m.spacing << " apart\n";
//
// All errors are pelage::Error, see error.h.

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pelage/io.h"

namespace pelage {

/// How the variance of a function is shared out among the eigenfunctions of the Laplace-Beltrami operator,
/// -laplacian phi = k^2 phi; on a closed plane these are waves of wave number k.
struct Spectrum {
  std::vector<double> wave_number;  ///< k, ascending [1 / world units]
  std::vector<double> share;        ///< of the variance there; their sum is 1

  bool empty() const { return wave_number.empty(); }
  /// The wave number below which a share of the variance lies, linear between the middles of steps. Of one that is not
  /// empty.
  double quantile(double share) const;
  /// Variance per unit of ln k at these wave numbers, each share smoothed by a Gaussian of ln k.
  std::vector<double> density(const std::vector<double>& at) const;
  /// Where this density is largest.
  double peak() const;
};

struct Spots {
  std::size_t count = 0;
  double diameter = 0;  ///< mean of those of discs of the same area [world units]
  double nearest = 0;   ///< mean distance from the centre of a spot to the nearest other one [world units]
  /// How many spots have how many neighbours: the triangles of Delaunay's triangulation at them. Spots whose cells
  /// reach the border of the surface are left out.
  std::map<std::size_t, std::size_t> neighbours;
};

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

/// The pattern of a number at every vertex of a shape, "u", or "u_2" of a vector, empty: the first: on a surface, at
/// the points of a cloud, or in a volume; for what nodes alone do not tell (border, width, coherence, along, defects,
/// neighbours) these have 0. `level`: where parts end; default: halfway between the lowest and the highest half percent
/// of the values. Error(Fault::usage) for an unknown name; Error(Fault::input) for a shape without numbers at its
/// vertices, without area, or that is no manifold.
PatternMeasures measure(const ShapeFile& shape, const std::string& field = "", const std::optional<double>& level = {});

/// What can be measured of it.
std::vector<std::string> field_names(const TriangleMesh& mesh);

}  // namespace pelage
