#include "discretise/space.h"

#include <cmath>

#include "base/random.h"
#include "linalg/conjugate_gradient.h"

namespace pelage {

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
