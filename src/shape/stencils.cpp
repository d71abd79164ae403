#include "shape/stencils.h"

namespace pelage {

std::vector<Point> combine(const Stencils& stencils, const std::vector<Point>& points) {
  std::vector<Point> result(stencils.rows(), Point{});
  parallel_for(stencils.rows(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      for (auto k = static_cast<std::size_t>(stencils.start[r]); k < static_cast<std::size_t>(stencils.start[r + 1]);
           ++k)
        for (std::size_t d = 0; d < 3; ++d)
          result[r][d] += stencils.weight[k] * points[static_cast<std::size_t>(stencils.index[k])][d];
  });
  return result;
}

}  // namespace pelage
