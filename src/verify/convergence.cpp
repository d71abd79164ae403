#include <cmath>

#include "linalg/conjugate_gradient.h"
#include "shape/generators.h"
#include "verify/figure.h"
#include "verify/problem.h"

namespace pelage {

namespace {

/// A function on a surface, with what the test needs; each takes a point near the surface.
struct ExactSolution {
  std::function<double(const Point&)> value;
  std::function<Point(const Point&)> gradient;     ///< tangential
  std::function<double(const Point&)> right_side;  ///< -div grad u + u
};

/// u = z + (x^2 - y^2) + xyz on the unit sphere: spherical harmonics of degree 1, 2, 3, with -div grad = l (l + 1).
ExactSolution on_sphere() {
  auto project = [](const Point& p) {
    const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return Point{p[0] / r, p[1] / r, p[2] / r};
  };
  ExactSolution s;
  s.value = [=](const Point& p) {
    const auto [x, y, z] = project(p);
    return z + x * x - y * y + x * y * z;
  };
  s.right_side = [=](const Point& p) {
    const auto [x, y, z] = project(p);
    return 3 * z + 7 * (x * x - y * y) + 13 * x * y * z;
  };
  s.gradient = [=](const Point& p) {
    const auto [x, y, z] = project(p);
    const Point g = {2 * x + y * z, -2 * y + x * z, 1 + x * y};
    const double normal = g[0] * x + g[1] * y + g[2] * z;
    return Point{g[0] - normal * x, g[1] - normal * y, g[2] - normal * z};
  };
  return s;
}

constexpr double torus_major = 1, torus_minor = 0.4;  // of the built-in torus, whose axis is z

struct TorusAngles {
  double theta, phi;  ///< around the tube, around the axis
};

TorusAngles torus_angles(const Point& p) {
  const double rho = std::hypot(p[0], p[1]);
  return {std::atan2(p[2], rho - torus_major), std::atan2(p[1], p[0])};
}

/// u = sin(2 phi) cos(theta) + sin(theta) on the torus.
ExactSolution on_torus() {
  ExactSolution s;
  s.value = [](const Point& p) {
    const auto [theta, phi] = torus_angles(p);
    return std::sin(2 * phi) * std::cos(theta) + std::sin(theta);
  };
  s.right_side = [value = s.value](const Point& p) {
    const auto [theta, phi] = torus_angles(p);
    const double radius = torus_major + torus_minor * std::cos(theta);
    const double u_theta = -std::sin(2 * phi) * std::sin(theta) + std::cos(theta);
    const double u_theta2 = -value(p);
    const double u_phi2 = -4 * std::sin(2 * phi) * std::cos(theta);
    const double laplacian = u_theta2 / (torus_minor * torus_minor) -
                             std::sin(theta) / (torus_minor * radius) * u_theta + u_phi2 / (radius * radius);
    return value(p) - laplacian;
  };
  s.gradient = [](const Point& p) {
    const auto [theta, phi] = torus_angles(p);
    const double radius = torus_major + torus_minor * std::cos(theta);
    const double along_theta = (-std::sin(2 * phi) * std::sin(theta) + std::cos(theta)) / torus_minor;
    const double along_phi = 2 * std::cos(2 * phi) * std::cos(theta) / radius;
    return Point{-along_theta * std::sin(theta) * std::cos(phi) - along_phi * std::sin(phi),
                 -along_theta * std::sin(theta) * std::sin(phi) + along_phi * std::cos(phi),
                 along_theta * std::cos(theta)};
  };
  return s;
}

struct Errors {
  double l2 = 0, h1 = 0;
};

Errors solve_and_measure(const TriangleMesh& mesh, const ExactSolution& exact) {
  const Problem p = make_problem(mesh, make_loop, true);
  const Sampling s = quadrature_sampling(p.discretisation, p.control);
  Vector f(s.count());
  for (Eigen::Index q = 0; q < f.size(); ++q) f[q] = exact.right_side(s.position[static_cast<std::size_t>(q)]);
  SparseMatrix system;
  combine(1, p.mass, 1, p.stiffness, system);
  const Vector u = solve_spd(system, load(s, f), {.tolerance = 1e-13, .max_iterations = 20000});
  const Vector value = s.values * u;
  const std::vector<Point> gradient = quadrature_gradients(p.discretisation, p.control, u);
  Errors e;
  for (Eigen::Index q = 0; q < f.size(); ++q) {
    const Point& place = s.position[static_cast<std::size_t>(q)];
    const Point expected = exact.gradient(place);
    e.l2 += s.weight[q] * std::pow(value[q] - exact.value(place), 2);
    for (std::size_t k = 0; k < 3; ++k)
      e.h1 += s.weight[q] * std::pow(gradient[static_cast<std::size_t>(q)][k] - expected[k], 2);
  }
  return {std::sqrt(e.l2), std::sqrt(e.h1)};
}

/// Orders in the mesh size h ~ n^-1/2 between two meshes.
std::vector<Figure> orders(const std::string& surface, const TriangleMesh& coarse, const TriangleMesh& fine,
                           const ExactSolution& exact, double l2_bound, double h1_bound) {
  const Errors a = solve_and_measure(coarse, exact), b = solve_and_measure(fine, exact);
  const double refinement =
      std::log(static_cast<double>(fine.points.size()) / static_cast<double>(coarse.points.size())) / 2;
  return {
      at_least("order in L2 of -div grad u + u = f on the " + surface, std::log(a.l2 / b.l2) / refinement, l2_bound),
      at_least("order in H1 of -div grad u + u = f on the " + surface, std::log(a.h1 / b.h1) / refinement, h1_bound)};
}

}  // namespace

std::vector<Figure> verify_convergence() {
  std::vector<Figure> figures = orders("torus", builtin_shape("builtin:torus?n=2048"),
                                       builtin_shape("builtin:torus?n=8192"), on_torus(), 3.9, 2.9);
  const std::vector<Figure> sphere = orders("sphere", builtin_shape("builtin:sphere?n=2562"),
                                            builtin_shape("builtin:sphere?n=10242"), on_sphere(), 2.4, 1.45);
  figures.insert(figures.end(), sphere.begin(), sphere.end());
  return figures;
}

}  // namespace pelage
