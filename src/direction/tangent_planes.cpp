#include "direction/tangent_planes.h"

#include <cmath>

#include "shape/vectors.h"

namespace pelage {

Point TangentPlanes::tangent(Index place, double angle) const {
  const auto v = static_cast<std::size_t>(place);
  const double x = std::cos(angle), y = std::sin(angle);
  return {x * east[v][0] + y * north[v][0], x * east[v][1] + y * north[v][1], x * east[v][2] + y * north[v][2]};
}

double TangentPlanes::angle(Index place, const Point& vector) const {
  const auto v = static_cast<std::size_t>(place);
  return std::atan2(dot(vector, north[v]), dot(vector, east[v]));
}

}  // namespace pelage
