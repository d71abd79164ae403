#include "discretise/space.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "linalg/conjugate_gradient.h"

namespace pelage {

SpaceBorder border_of(const std::map<Index, std::map<Index, double>>& mass) {
  SpaceBorder border;
  for (const auto& [node, row] : mass) border.node.push_back(node);
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = static_cast<std::int32_t>(border.node.size());
  for (const auto& [node, row] : mass) {
    for (const auto& [other, entry] : row) {
      const auto column = std::ranges::lower_bound(border.node, other) - border.node.begin();
      pattern->column.push_back(static_cast<std::int32_t>(column));
      border.mass.value.push_back(entry);
    }
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  border.mass.pattern = std::move(pattern);
  return border;
}

double largest_k2(const SparseMatrix& mass, const SparseMatrix& stiffness) {
  Vector x(stiffness.rows());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 2 * uniform(0, static_cast<std::uint64_t>(i)) - 1;
  double k2 = 0;
  for (int iteration = 0; iteration < 25; ++iteration) {
    const Vector y = solve_spd(mass, stiffness * x, {.tolerance = 1e-4});
    k2 = std::sqrt(dot(y, y) / dot(x, x));
    x = y / norm(y);
  }
  return 1.1 * k2;  // power iteration comes from below
}

}  // namespace pelage
