#pragma once
// Wishes for direction_field: strokes, an axis, principal curvatures, the gradient of a harmonic function.

#include <functional>
#include <optional>

#include "direction/direction_field.h"
#include "discretise/anisotropy.h"

namespace pelage {

/// Along or across what guides.
enum class Sense { along, across };

/// The places nearest to a polyline in space follow it exactly; `edge` from a place to the next. Error(Fault::usage)
/// below two different points, and for one that is very long.
std::vector<Guide> stroke_guides(const TangentPlanes& planes, const std::vector<Point>& points, double edge,
                                 const std::vector<Point>& stroke);

/// Every place follows the tangential part of a vector; `weight` [1 / world^2] where the vector is tangent, less by
/// the squared sine of its angle to the normal elsewhere. Error(Fault::usage) for a vector of length 0.
std::vector<Guide> axis_guides(const TangentPlanes& planes, const Point& axis, double weight, Sense sense);

/// Every place follows the tangential part of its way from a centre, likewise weighted.
std::vector<Guide> centre_guides(const TangentPlanes& planes, const std::vector<Point>& points, const Point& centre,
                                 double weight, Sense sense);

/// Every place follows the direction of the larger principal curvature (along) or the smaller (across), with the
/// weight strength (k1 - k2)^2: strong where the surface has a direction, none where it is round or flat. `curvature`:
/// tensors k1 e1 e1' + k2 e2 e2' in space.
std::vector<Guide> curvature_guides(const TangentPlanes& planes, const std::vector<Tensor>& curvature, double strength,
                                    Sense sense);

/// Error(Fault::usage) when one of the lists is empty or a vertex is not one of so many or in both.
void require_marks(Index vertices, const std::vector<Index>& low, const std::vector<Index>& high);

/// The harmonic function on linked places (of the links the weights count) that is 0 at the places `low` and 1 at
/// `high`, natural at boundaries. Constant 0 on pieces without marks. The errors of require_marks.
std::vector<double> harmonic_function(Index places, const std::vector<PlaneLink>& links, const std::vector<Index>& low,
                                      const std::vector<Index>& high);
/// The same on a mesh, with the cotangent Laplacian.
std::vector<double> harmonic_function(const Connection& connection, const std::vector<Index>& low,
                                      const std::vector<Index>& high);

/// Every place follows the gradient of a function (or runs across it), each with the same `weight` [1 / world^2]
/// whatever the length of the gradient; places where that is 0 are free.
std::vector<Guide> gradient_guides(const TangentPlanes& planes, const std::vector<Point>& gradient, double weight,
                                   Sense sense);
/// At the vertices of a mesh, of a function that is linear on its triangles: sums over the triangles around, times
/// twice their areas.
std::vector<Point> vertex_gradients(const Topology& topology, const std::vector<Point>& points,
                                    const std::vector<double>& function);

/// Default of FieldWish::smooth, as a fraction of the diagonal.
inline constexpr double default_field_smoothing = 0.05;

/// What a field is to follow; all together, or nothing for the smoothest field.
struct FieldWish {
  std::optional<Point> axis;
  std::optional<Point> centre;  ///< [world]
  bool curvature = false;
  std::vector<Index> from, to;  ///< the harmonic function that is 0 at the first and 1 at the others
  std::vector<std::vector<Point>> strokes;
  bool across = false;  ///< all but strokes
  double smooth = 0;    ///< length over which wishes, strokes excepted, are smoothed [world]
};

/// What guides of a wish ask of a surface.
struct GuidedSurface {
  const TangentPlanes& planes;
  const std::vector<Point>& points;
  double edge;  ///< from a place to the next [world]
  std::function<std::vector<Tensor>()> curvature;
  /// Along the gradient of the harmonic function that is 0 at `low` and 1 at `high`.
  std::function<std::vector<Point>(const std::vector<Index>& low, const std::vector<Index>& high)> way;
};

/// The guides of a wish; `diagonal` of the shape's bounding box.
std::vector<Guide> find_guides(const FieldWish& wish, const GuidedSurface& surface, double diagonal);
/// The same on a mesh, with the curvature of its Loop surface.
std::vector<Guide> find_guides(const FieldWish& wish, const Connection& connection, const std::vector<Point>& points,
                               double diagonal);

}  // namespace pelage
