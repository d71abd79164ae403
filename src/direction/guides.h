#pragma once
// Wishes for direction_field: strokes, an axis, principal curvatures, the gradient of a harmonic function.

#include <optional>

#include "direction/direction_field.h"
#include "discretise/discretisation.h"

namespace pelage {

/// Along or across what guides.
enum class Sense { along, across };

/// The vertices nearest to a polyline in space follow it exactly. Error(Fault::usage) below two different points.
std::vector<Guide> stroke_guides(const Connection& connection, const std::vector<Point>& points,
                                 const std::vector<Point>& stroke);

/// Every vertex follows the tangential part of a vector; `weight` [1 / world^2] where the vector is tangent, less by
/// the squared sine of its angle to the normal elsewhere. Error(Fault::usage) for a vector of length 0.
std::vector<Guide> axis_guides(const Connection& connection, const Point& axis, double weight, Sense sense);

/// Every vertex follows the tangential part of its way from a place, likewise weighted.
std::vector<Guide> centre_guides(const Connection& connection, const std::vector<Point>& points, const Point& centre,
                                 double weight, Sense sense);

/// Every vertex follows the direction of the larger principal curvature (along) or the smaller (across), with the
/// weight strength (k1 - k2)^2: strong where the surface has a direction, none where it is round or flat.
std::vector<Guide> curvature_guides(const Connection& connection, const Discretisation& discretisation,
                                    const std::vector<Point>& control, double strength, Sense sense);

/// The harmonic function that is 0 at the vertices `low` and 1 at `high`, natural at boundaries. Constant 0 on pieces
/// of the mesh without marks. Error(Fault::usage) when one of the lists is empty or a vertex is not of the mesh or in
/// both.
std::vector<double> harmonic_function(const Connection& connection, const std::vector<Index>& low,
                                      const std::vector<Index>& high);

/// Every vertex follows the gradient of a function given at the vertices (or runs across it), each with the same
/// `weight` [1 / world^2] whatever the length of the gradient; places without gradient are free.
std::vector<Guide> gradient_guides(const Connection& connection, const std::vector<Point>& points,
                                   const std::vector<double>& function, double weight, Sense sense);

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

/// The guides of a wish; `diagonal` of the shape's bounding box.
std::vector<Guide> find_guides(const FieldWish& wish, const Connection& connection, const std::vector<Point>& points,
                               double diagonal);

}  // namespace pelage
