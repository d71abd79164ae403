#pragma once
// Direction fields on surfaces: at every vertex tangent directions, as smooth as the surface and the wishes allow.
//
//   const pelage::SurfaceField field = pelage::surface_field(pelage::load_shape("cow.obj"));
//
// All errors are pelage::Error, see error.h.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pelage/error.h"
#include "pelage/point.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// What a field is to follow, all together; nothing makes the smoothest field.
struct FieldOptions {
  int n = 2;                           ///< directions per vertex: 1 vectors, 2 lines, 4 crosses
  std::optional<Point> axis;           ///< the projection of this vector
  bool curvature = false;              ///< the larger principal curvature, where there is one
  std::vector<std::int32_t> from, to;  ///< the gradient of the harmonic function that is 0 at the ones and 1 at the
                                       ///< other vertices
  std::vector<std::vector<Point>> strokes;  ///< polylines near the surface, followed exactly; world units
  bool across = false;                      ///< the others, strokes excepted, turned by a right angle
  std::optional<double> smooth;             ///< length over which they are smoothed; default: 0.05 diagonals [world]
};

/// Where the directions turn around: the index counts turns by 2 pi / n, counter-clockwise.
struct Singularity {
  std::int32_t face = 0;
  int index = 0;
};

struct SurfaceField {
  int n = 2;
  std::vector<Point> direction;            ///< per vertex: one of the n, a unit tangent
  std::vector<Singularity> singularities;  ///< on a closed mesh the indices add up to n times its Euler characteristic
  double roughness = 0;                    ///< mean square of the turn per length, times n^2 [1 / world^2]
};

/// The mesh is one that load_shape() or check_shape() gave (io.h). Error(Fault::usage) unless n is 1, 2 or 4, for
/// vertices that the mesh does not have, an axis of length 0, strokes without length, and `smooth` unless it is greater
/// than 0; Error(Fault::numerics) when the solver does not converge.
SurfaceField surface_field(const TriangleMesh& mesh, const FieldOptions& options = {});

/// The mesh with the directions of a field as its attribute "direction", which anisotropic models follow.
TriangleMesh with_directions(TriangleMesh mesh, const std::vector<Point>& direction);

/// Several fields on one mesh, whose geometry is looked at once. Not copyable; fields may be made in several threads.
class FieldMaker {
 public:
  explicit FieldMaker(const TriangleMesh& mesh);
  ~FieldMaker();
  FieldMaker(FieldMaker&&) noexcept;
  FieldMaker& operator=(FieldMaker&&) noexcept;

  /// Errors as above.
  SurfaceField make(const FieldOptions& options = {}) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace pelage
