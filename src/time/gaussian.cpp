#include <cmath>

#include "base/dense.h"
#include "time/lattice_step.h"

namespace pelage {

namespace {

/// (e^(bt) - 1) / b.
double gamma(double b, double t) { return b == 0 ? t : std::expm1(b * t) / b; }

/// Eq. (12) of Witkin, Kass 1991: what has reacted spreads and decays for the length of a step as it would alone,
///   u' = (u + gamma N(u)) * G,   gamma = (e^(b dt) - 1) / b,
/// with the Gaussian G of div T grad - b in dt, exact for every wave, and R = N - b u. Of first order.
class Gaussian final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override;

 private:
  /// Of one species in a step dt.
  struct Kernel {
    double dt = 0, c = 0;
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    std::vector<double> of_wave;

    void update(const LatticeTransform<double>& transform, double step, double linear, const Eigen::Matrix3d& t);
  };
  void bind(const System& system);

  std::optional<LatticeTransform<double>> transform_;
  LinearParts parts_;
  std::vector<Kernel> kernels_;
  std::vector<double> waves_;
  std::vector<Vector> next_;
};

void Gaussian::Kernel::update(const LatticeTransform<double>& transform, double step, double linear,
                              const Eigen::Matrix3d& t) {
  if (dt == step && c == linear && tensor == t) return;
  dt = step;
  c = linear;
  tensor = t;
  of_wave = transform.quadratic_form(tensor);
  parallel_for(of_wave.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) of_wave[w] = std::exp(dt * (c - of_wave[w]));
  });
}

void Gaussian::bind(const System& system) {
  if (transform_ && transform_->lattice() == *system.lattice && kernels_.size() == system.species.size()) return;
  transform_.emplace(*system.lattice);
  waves_.resize(transform_->size());
  kernels_.assign(system.species.size(), {});
}

StepReport Gaussian::step(const System& system, State& state, const StepRequest& request) {
  if (std::string why = why_no_waves(system); !why.empty()) return refusal(std::move(why));
  StepReport report;
  bind(system);
  parts_.split(system, state.now, state.time);
  next_ = state.now;
  for (const std::size_t i : evolving_species(system)) {
    Kernel& kernel = kernels_[i];
    kernel.update(*transform_, request.dt, parts_.c(i), *system.species[i].tensor);
    axpby(gamma(-parts_.c(i), request.dt), parts_.rest(i), 1, next_[i]);
    transform_->forward(next_[i].data(), waves_.data());
    for_waves(*transform_, [&](std::size_t w, std::size_t n) { waves_[n] *= kernel.of_wave[w]; });
    transform_->inverse(waves_.data(), next_[i].data());
  }
  report.iterations = 1;
  advance(system, state, request.dt, next_, report);
  return report;
}

Eigen::MatrixXd amplification(const Linearisation& l, double dt, const Eigen::MatrixXd& decay) {
  const Eigen::Index n = l.jacobian.rows();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n), rest = l.jacobian;
  for (Eigen::Index i = 0; i < n; ++i) {
    factor(i, i) = std::exp(dt * (l.c2[i] - decay(i, i)));
    rest(i, i) -= l.c2[i];
    rest.row(i) *= gamma(-l.c2[i], dt);
  }
  return factor * (Eigen::MatrixXd::Identity(n, n) + rest);
}

}  // namespace

constexpr StepperKind gaussian_stepper = {
    .name = "gaussian",
    .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<Gaussian>(); },
    .amplification = amplification,
    .lattice = true,
    .matrix_free = true,
    .nodal = true};

}  // namespace pelage
