#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "discretise/curvature.h"
#include "discretise/sampling.h"
#include "fair/diffusivity.h"
#include "fair/faces.h"
#include "fair/flow.h"
#include "linalg/conjugate_gradient.h"

namespace pelage {

namespace {

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

Eigen::Matrix3d as_matrix(const Tensor& t) {
  Eigen::Matrix3d m;
  m << t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5];
  return m;
}

/// Solves (M + tau K) x = M x0 for the three coordinates, by their steps x - x0: these do not depend on where the mesh
/// lies.
std::vector<Point> diffused(const SparseMatrix& mass, const SparseMatrix& stiffness, double tau,
                            const std::vector<Point>& points) {
  SparseMatrix matrix;
  combine(1, mass, tau, stiffness, matrix);
  std::vector<Point> result = points;
  for (std::size_t k = 0; k < 3; ++k) {
    Vector x(static_cast<Eigen::Index>(points.size()));
    for (Eigen::Index v = 0; v < x.size(); ++v) x[v] = points[at(v)][k];
    const Vector step = solve_spd(matrix, -tau * (stiffness * x), {.tolerance = 1e-8});
    for (Eigen::Index v = 0; v < x.size(); ++v) result[at(v)][k] += step[v];
  }
  return result;
}

/// a(x) at the vertices: the mean square of the edges around each, over that of the whole mesh.
Vector local_size(const Topology& topology, const std::vector<Point>& points) {
  Vector sum = Vector::Zero(topology.vertex_count), count = sum;
  for (Index h = 0; h < static_cast<Index>(topology.twin.size()); ++h) {
    const Index a = topology.origin(h), b = topology.target(h);
    const double square = (vector3(points[at(a)]) - vector3(points[at(b)])).squaredNorm();
    sum[a] += square, sum[b] += square, count[a] += 1, count[b] += 1;
  }
  const double mean = sum.sum() / count.sum();
  return sum.cwiseQuotient(count.cwiseMax(1)) / mean;
}

/// Anisotropic diffusion of the control points, eqs (18)-(21) of Bajaj, Zhang, Xu 2008:
///   (M_mu + tau K) x^(n+1) = M_mu x^n,  M_mu = (a^-mu phi, phi),  K = (a^(1-mu) D grad phi, grad phi).
/// What the paper leaves open: the curvatures in D are those of the surface after one implicit isotropic step of time
/// sigma^2 / 2; vertices move along the normals of that surface only, because motion along the surface folds corners.
class Paper final : public FairMethod {
 public:
  Paper(const FairState& state, double tau, double sigma, double angle, double mu)
      : discretisation_(loop_discretisation(state.topology)),
        assembler_(discretisation_),
        values_(quadrature_values(discretisation_)),
        size_(local_size(state.topology, state.points)),
        tau_(tau),
        sigma_(sigma),
        angle_(angle),
        mu_(mu) {}

  void step(FairState& s, FairReport& report) override {
    const double h = report.mean_edge;
    const std::vector<Point> smooth =
        diffused(assembler_.mass(s.points), assembler_.stiffness(s.points), sigma_ * sigma_ * h * h / 2, s.points);
    const std::vector<Point> next =
        diffused(assembler_.mass(s.points, powers(-mu_)), assembler_.stiffness(s.points, tensors(smooth, angle_ / h)),
                 tau_ * h * h, s.points);
    const std::vector<Point> normal = limit_normals(discretisation_, smooth);
    for (std::size_t v = 0; v < s.points.size(); ++v) {
      if (s.fixed[v]) continue;
      const Vector3 n = vector3(normal[v]);
      const double along = n.dot(vector3(next[v]) - vector3(s.points[v]));
      for (std::size_t k = 0; k < 3; ++k) s.points[v][k] += along * normal[v][k];
    }
  }

  int most_steps() const override { return 12; }

 private:
  /// a^exponent at the quadrature points.
  std::vector<double> powers(double exponent) const {
    const Vector a = values_ * size_;
    std::vector<double> result(at(a.size()));
    for (Eigen::Index q = 0; q < a.size(); ++q) result[at(q)] = std::pow(a[q], exponent);
    return result;
  }

  std::vector<Tensor> tensors(const std::vector<Point>& smooth, double lambda) const {
    std::vector<Tensor> tensor = quadrature_curvature(discretisation_, smooth);
    const std::vector<double> factor = powers(1 - mu_);
    parallel_for(tensor.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t q = begin; q < end; ++q)
        tensor[q] = diffusion_tensor(as_matrix(tensor[q]), [&](double k) { return factor[q] * throttle(k, lambda); });
    });
    return tensor;
  }

  Discretisation discretisation_;
  Assembler assembler_;
  SparseMatrix values_;
  Vector size_;
  double tau_, sigma_, angle_, mu_;
};

}  // namespace

std::unique_ptr<FairMethod> make_paper_method(const FairState& state, const FairOptions& options, FairReport& report) {
  report.tau = options.tau.value_or(0.2);
  report.sigma = options.sigma.value_or(1.0);
  report.angle = options.angle.value_or(11.5);  // 0.2 per edge
  return std::make_unique<Paper>(state, report.tau, report.sigma, report.angle * std::numbers::pi / 180, options.mu);
}

}  // namespace pelage
