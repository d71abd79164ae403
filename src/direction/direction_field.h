#pragma once
// Direction fields: at every vertex n tangent directions, evenly spaced by 2 pi / n (n = 1: vectors, 2: lines, 4:
// crosses), as smooth as the surface and the wishes about them allow (Knoeppel, Crane, Pinkall, Schroeder 2013).
//
// With z = exp(i n angle) the roughness sum w_ij |z_j - exp(i n r_ij) z_i|^2 is a quadratic form A, the connection
// Laplacian; singularities place themselves.

#include <complex>
#include <vector>

#include "direction/connection.h"

namespace pelage {

/// The attribute of a mesh that holds its directions: 3 components per vertex.
inline constexpr const char* direction_attribute = "direction";

/// What is wished at a vertex, or at another place that has a tangent plane.
struct Guide {
  Index vertex = 0;
  Point direction{};  ///< its tangential part counts
  double weight =
      0;  ///< against roughness: 1 / length^2 [1 / world^2] over which the field may turn; infinite: exactly
};

struct DirectionField {
  int n = 2;                     ///< directions per vertex
  std::vector<double> angle;     ///< per vertex, in the polar coordinates of the connection [rad]
  std::vector<Point> direction;  ///< per vertex: one of the n as a unit tangent
  std::vector<int> index;        ///< per face, of meshes: turns / (2 pi / n) around it; 0 where the field is regular
  double roughness = 0;          ///< smallest eigenvalue; of a guided field its Rayleigh quotient [1 / world^2]
  int iterations = 0;            ///< of the linear solver
};

/// The smoothest field; with guides, the one that minimises z'Az + sum of weight area |z - guide|^2. Pieces of the mesh
/// without guides get their smoothest field. Boundaries do not ask for anything. Error(Fault::usage) unless n is 1, 2
/// or 4, or when a guide's vertex is not one of the mesh; Error(Fault::numerics) when the solver does not converge.
DirectionField direction_field(const Connection& connection, int n, const std::vector<Guide>& guides = {});
/// The same of any places that are linked.
DirectionField direction_field(const TangentPlanes& planes, const std::vector<PlaneLink>& links, int n,
                               const std::vector<Guide>& guides = {});

/// The index of every face (Knoeppel et al. 2013, section 6.2): over a closed mesh they add up to n times its Euler
/// characteristic.
std::vector<int> singularity_indices(const Connection& connection, int n, const std::vector<double>& angle);

}  // namespace pelage
