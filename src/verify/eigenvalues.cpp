#include <cmath>

#include "base/dense.h"
#include "linalg/conjugate_gradient.h"
#include "shape/generators.h"
#include "verify/figure.h"
#include "verify/problem.h"

namespace pelage {

namespace {

constexpr int harmonics = 16;  // of degree 0 to 3

/// A basis of the harmonic polynomials of degree at most 3.
std::array<double, harmonics> solid_harmonics(const Point& p) {
  const auto [x, y, z] = p;
  return {1,
          x,
          y,
          z,
          x * y,
          y * z,
          z * x,
          x * x - y * y,
          2 * z * z - x * x - y * y,
          x * y * z,
          z * (x * x - y * y),
          x * (x * x - 3 * y * y),
          y * (3 * x * x - y * y),
          x * (4 * z * z - x * x - y * y),
          y * (4 * z * z - x * x - y * y),
          z * (2 * z * z - 3 * x * x - 3 * y * y)};
}

/// The smallest 16 eigenvalues of K x = lambda M x by inverse iteration of a subspace that starts from the harmonics.
Vector smallest_eigenvalues(const Problem& p) {
  SparseMatrix shifted;
  combine(1, p.stiffness, 1, p.mass, shifted);
  const auto n = static_cast<Eigen::Index>(p.control.size());
  const std::vector<Point> position = limit_positions(p.discretisation, p.control);
  Eigen::MatrixXd basis(n, harmonics);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = solid_harmonics(position[static_cast<std::size_t>(i)]);
    basis.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), harmonics);
  }
  Vector eigenvalues;
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::MatrixXd mass_basis(n, harmonics), stiffness_basis(n, harmonics);
    for (int k = 0; k < harmonics; ++k) {
      basis.col(k) = solve_spd(shifted, p.mass * Vector(basis.col(k)), {.tolerance = 1e-12});
      mass_basis.col(k) = p.mass * Vector(basis.col(k));
      stiffness_basis.col(k) = p.stiffness * Vector(basis.col(k));
    }
    const Modes ritz = symmetric_modes(basis.transpose() * stiffness_basis, basis.transpose() * mass_basis);
    eigenvalues = ritz.values;
    basis *= ritz.vectors;
  }
  return eigenvalues;
}

/// Largest relative errors of the eigenvalues l (l + 1), l = 1, 2, 3.
std::array<double, 3> relative_errors(const Vector& eigenvalues) {
  std::array<double, 3> worst{};
  int k = 1;
  for (int l = 1; l <= 3; ++l)
    for (int m = 0; m < 2 * l + 1; ++m, ++k) {
      double& w = worst[static_cast<std::size_t>(l - 1)];
      w = std::max(w, std::abs(eigenvalues[k] / (l * (l + 1)) - 1));
    }
  return worst;
}

}  // namespace

std::vector<Figure> verify_eigenvalues() {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=2562");
  const auto loop = relative_errors(smallest_eigenvalues(make_problem(sphere, make_loop, true)));
  const auto linear = relative_errors(smallest_eigenvalues(make_problem(sphere, make_linear, false)));
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string degree = std::to_string(i + 1);
    figures.push_back(
        at_most("relative error of the sphere's eigenvalue l = " + degree + ", 2562 vertices", loop[i], 4e-5));
    figures.push_back(
        at_least("the same: error of linear elements over that of Loop elements", linear[i] / loop[i], 100));
  }
  return figures;
}

}  // namespace pelage
