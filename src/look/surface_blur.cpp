#include "look/surface_blur.h"

#include <numbers>

#include "discretise/method.h"
#include "pelage/error.h"
#include "shape/topology.h"

namespace pelage {

namespace {

/// (M + a K) x = b, from the x that is there.
class Solver {
 public:
  Solver(const SparseMatrix& mass, double a, const SparseMatrix& stiffness) {
    combine(1, mass, a, stiffness, matrix_ = mass);
    preconditioner_ = Jacobi<Vector>(diagonal(matrix_));
  }
  void solve(const Vector& b, Vector& x) {
    constexpr ConjugateGradientOptions options{1e-6, 20'000};
    if (!conjugate_gradient(matrix_, preconditioner_, b, x, nullptr, options, work_).converged)
      throw Error(Fault::numerics, "colours could not be blurred on the surface: it has triangles without area");
  }

 private:
  SparseMatrix matrix_;
  Jacobi<Vector> preconditioner_;
  ConjugateGradientWork<Vector> work_;
};

}  // namespace

SurfaceBlur::SurfaceBlur(const std::vector<Triangle>& triangles, std::vector<Point> points) {
  auto topology = std::make_shared<const Topology>(make_topology(points.size(), triangles));
  const auto space = linear_method.make_space(std::move(topology), std::move(points));
  mass_ = space->sampled(SampleRule::vertices).mass;
  stiffness_ = space->stiffness();
}

void SurfaceBlur::blur(std::vector<Vector>& values, double variance) const {
  constexpr int steps = 2;  // one alone is off by 7 % where the variance is multiplied by four
  constexpr double gamma = 1 - 1 / std::numbers::sqrt2;
  Solver solver(*mass_, gamma * variance / 2 / steps, *stiffness_);
  for (Vector& u : values)
    for (int k = 0; k < steps; ++k) {
      Vector half_way = u;
      solver.solve(*mass_ * u, half_way);
      const Vector begin = u + (1 - gamma) / gamma * (half_way - u);
      u = half_way;
      solver.solve(*mass_ * begin, u);
    }
}

double SurfaceBlur::mean(const Vector& values) const {
  return sum(*mass_ * values) / sum(*mass_ * Vector::Ones(values.size()));
}

}  // namespace pelage
