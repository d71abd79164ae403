#include "discretise/assembly.h"
#include "fair/faces.h"
#include "fair/flow.h"
#include "linalg/conjugate_gradient.h"

namespace pelage {

namespace {

/// (M + tau K) x^(n+1) = M x^n with cotangent weights (Desbrun, Meyer, Schroeder, Barr 1999), solved for the step,
/// which does not depend on where the mesh lies; fixed vertices stay.
class Isotropic final : public FairMethod {
 public:
  explicit Isotropic(double tau) : tau_(tau) {}

  void step(FairState& s, FairReport& report) override {
    const Discretisation d = linear_discretisation(s.topology);
    const Assembler assembler(d);
    const SparseMatrix stiffness = assembler.stiffness(s.points);
    const double time = tau_ * report.mean_edge * report.mean_edge;
    SparseMatrix matrix;
    combine(1, assembler.mass(s.points), time, stiffness, matrix);
    const std::vector<Point> before = s.points;
    for (std::size_t k = 0; k < 3; ++k) {
      Vector x(static_cast<Eigen::Index>(before.size()));
      for (std::size_t v = 0; v < before.size(); ++v) x[static_cast<Eigen::Index>(v)] = before[v][k];
      const Vector step = solve_spd(matrix, -time * (stiffness * x), {.tolerance = 1e-9});
      for (std::size_t v = 0; v < before.size(); ++v)
        if (!s.fixed[v]) s.points[v][k] += step[static_cast<Eigen::Index>(v)];
    }
  }

  int most_steps() const override { return 20; }

 private:
  double tau_;
};

/// Umbrella steps forward and, to undo the shrinking, backward (Taubin 1995): lambda = 0.5, mu = -0.53.
class Taubin final : public FairMethod {
 public:
  void step(FairState& s, FairReport&) override {
    umbrella(s, 0.5);
    umbrella(s, -0.53);
  }
  int most_steps() const override { return 50; }

 private:
  static void umbrella(FairState& s, double factor) {
    std::vector<Vector3> sum(s.points.size(), Vector3::Zero());
    std::vector<int> count(s.points.size(), 0);
    for (std::size_t h = 0; h < s.topology.twin.size(); ++h) {
      const Index a = s.topology.origin(static_cast<Index>(h)), b = s.topology.target(static_cast<Index>(h));
      sum[a] += vector3(s.points[b]);
      ++count[a];
    }
    for (std::size_t v = 0; v < s.points.size(); ++v) {
      if (s.fixed[v] || count[v] == 0) continue;
      const Vector3 step = factor * (sum[v] / count[v] - vector3(s.points[v]));
      for (std::size_t k = 0; k < 3; ++k) s.points[v][k] += step[static_cast<int>(k)];
    }
  }
};

}  // namespace

std::unique_ptr<FairMethod> make_isotropic_method(const FairOptions& options, FairReport& report) {
  report.tau = options.tau.value_or(0.1);  // small enough for the stop to choose between steps
  return std::make_unique<Isotropic>(report.tau);
}

std::unique_ptr<FairMethod> make_taubin_method() { return std::make_unique<Taubin>(); }

}  // namespace pelage
