#include "run/program.h"

#include <algorithm>
#include <cmath>

namespace pelage {

std::string field_name(const std::string& stage, const std::string& species) { return stage + "." + species; }

double bounding_diagonal(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return 0;
  Point low = mesh.points[0], high = low;
  for (const Point& p : mesh.points)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

}  // namespace pelage
