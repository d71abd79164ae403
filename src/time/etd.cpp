#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/parallel.h"
#include "time/etd_series.h"
#include "time/exponential.h"
#include "time/lattice_step.h"

namespace pelage {

namespace {

/// What multiplies the waves of one species in a step h, with z = h (c - k.Tk).
struct Multipliers {
  double h = 0, c = 0;
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  std::vector<double> half_exp, half_phi1, exp, phi1, second, third;

  void update(const LatticeTransform<double>& transform, double step, double linear, const Eigen::Matrix3d& t);
};

void Multipliers::update(const LatticeTransform<double>& transform, double step, double linear,
                         const Eigen::Matrix3d& t) {
  if (h == step && c == linear && tensor == t) return;
  h = step;
  c = linear;
  tensor = t;
  const std::vector<double> form = transform.quadratic_form(tensor);
  for (auto* list : {&half_exp, &half_phi1, &exp, &phi1, &second, &third}) list->resize(form.size());
  parallel_for(form.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) {
      const Phi p = phi_functions(h * (c - form[w]));
      half_exp[w] = p.half_exp;
      half_phi1[w] = h / 2 * p.half_phi1;
      exp[w] = p.exp;
      phi1[w] = h * p.phi1;
      second[w] = 4 * h * (p.phi2 - 2 * p.phi3);
      third[w] = h * (4 * p.phi3 - p.phi2);
    }
  });
}

/// Exponential time differencing of third order with an error of second (Cox, Matthews 2002, ETD3RK), for
/// du/dt = L u + N(u, t) with L = div T grad + c exact for every wave:
///   a   = e^(hL/2) u + h/2 phi_1(hL/2) N(u)
///   b   = e^(hL) u + h phi_1(hL) (2 N(a) - N(u))
///   u'  = e^(hL) u + h phi_1 N(u) + 4h (phi_2 - 2 phi_3) (N(a) - N(u)) + h (4 phi_3 - phi_2) (N(b) - N(u))
/// The scheme of second order that takes N(u) and N(a) alone differs by h (4 phi_3 - phi_2) (N(u) - 2 N(a) + N(b)).
/// Wave by wave on even grids that need no matrices, and elsewhere by series, see time/etd_series.h.
class Etd final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override;

 private:
  struct Waves {
    std::vector<double> now, rest, middle;  ///< of u, N(u), N(a)
  };
  void bind(const System& system);
  void to_waves(const Vector& field, std::vector<double>& waves) const;
  void to_field(std::vector<double>& waves, Vector& field) const;
  double finish(std::vector<Vector>& next);

  EtdBySeries series_;
  std::optional<LatticeTransform<double>> transform_;
  std::vector<std::size_t> evolving_;
  LinearParts parts_;
  std::vector<Multipliers> multipliers_;
  std::vector<Waves> waves_;
  std::vector<double> work_;
  std::vector<Vector> next_;
};

void Etd::bind(const System& system) {
  evolving_ = evolving_species(system);
  if (transform_ && transform_->lattice() == *system.lattice && waves_.size() == system.species.size()) return;
  transform_.emplace(*system.lattice);
  multipliers_.assign(system.species.size(), {});
  waves_.resize(system.species.size());
  work_.resize(transform_->size());
  for (Waves& w : waves_)
    for (auto* list : {&w.now, &w.rest, &w.middle}) list->resize(transform_->size());
}

void Etd::to_waves(const Vector& field, std::vector<double>& waves) const {
  transform_->forward(field.data(), waves.data());
}

void Etd::to_field(std::vector<double>& waves, Vector& field) const {
  field.resize(static_cast<Eigen::Index>(transform_->lattice().nodes()));
  transform_->inverse(waves.data(), field.data());
}

/// The last stage; the error relative to the size of the fields, the largest of all species.
double Etd::finish(std::vector<Vector>& next) {
  double worst = 0;
  for (const std::size_t i : evolving_) {
    Waves& u = waves_[i];
    const Multipliers& m = multipliers_[i];
    to_waves(parts_.rest(i), work_);
    for_waves(*transform_, [&](std::size_t w, std::size_t n) {
      u.now[n] += m.third[w] * (work_[n] - u.rest[n]);
      u.middle[n] = m.third[w] * (u.rest[n] - 2 * u.middle[n] + work_[n]);
    });
    const double error = transform_->mean_square(u.middle), size = transform_->mean_square(u.now);
    if (error > 0) worst = std::max(worst, std::sqrt(error / std::max(size, negligible * negligible)));
    to_field(u.now, next[i]);
  }
  return worst;
}

StepReport Etd::step(const System& system, State& state, const StepRequest& request) {
  if (system.mass) return series_.step(system, state, request);
  if (std::string why = why_no_waves(system); !why.empty()) return refusal(std::move(why));
  StepReport report;
  bind(system);
  const double h = request.dt, t = state.time;
  parts_.split(system, state.now, t);
  next_ = state.now;
  for (const std::size_t i : evolving_) {
    Waves& u = waves_[i];
    Multipliers& m = multipliers_[i];
    m.update(*transform_, h, parts_.c(i), *system.species[i].tensor);
    to_waves(state.now[i], u.now);
    to_waves(parts_.rest(i), u.rest);
    for_waves(*transform_,
              [&](std::size_t w, std::size_t n) { work_[n] = m.half_exp[w] * u.now[n] + m.half_phi1[w] * u.rest[n]; });
    to_field(work_, next_[i]);
  }
  parts_.evaluate(system, next_, t + h / 2);
  for (const std::size_t i : evolving_) {
    Waves& u = waves_[i];
    const Multipliers& m = multipliers_[i];
    to_waves(parts_.rest(i), u.middle);
    for_waves(*transform_, [&](std::size_t w, std::size_t n) {
      const double grown = m.exp[w] * u.now[n], change = u.middle[n] - u.rest[n];
      work_[n] = grown + m.phi1[w] * (u.middle[n] + change);
      u.now[n] = grown + m.phi1[w] * u.rest[n] + m.second[w] * change;
    });
    to_field(work_, next_[i]);
  }
  parts_.evaluate(system, next_, t + h);
  report.error = finish(next_);
  report.iterations = 3;
  if (!(report.error > request.largest_error)) advance(system, state, h, next_, report);
  return report;
}

/// A wave whose C2 is constant.
Eigen::MatrixXd amplification(const Linearisation& l, double dt, const Eigen::MatrixXd& decay) {
  const Eigen::Index n = l.jacobian.rows();
  const Eigen::MatrixXd rest = l.jacobian - Eigen::MatrixXd(l.c2.asDiagonal()), one = Eigen::MatrixXd::Identity(n, n);
  const auto diagonal = [&](auto&& member) {
    Eigen::MatrixXd d = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) d(i, i) = phi_functions(dt * (l.c2[i] - decay(i, i))).*member;
    return d;
  };
  const Eigen::MatrixXd exp = diagonal(&Phi::exp), phi1 = dt * diagonal(&Phi::phi1), phi2 = dt * diagonal(&Phi::phi2),
                        phi3 = dt * diagonal(&Phi::phi3);
  const Eigen::MatrixXd a = diagonal(&Phi::half_exp) + dt / 2 * diagonal(&Phi::half_phi1) * rest;
  const Eigen::MatrixXd b = exp + phi1 * rest * (2 * a - one);
  return exp + phi1 * rest + 4 * (phi2 - 2 * phi3) * rest * (a - one) + (4 * phi3 - phi2) * rest * (b - one);
}

}  // namespace

constexpr StepperKind etd = {.name = "etd",
                             .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<Etd>(); },
                             .adaptive = true,
                             .holds = true,
                             .amplification = amplification,
                             .tolerance = 3e-3,
                             .jump_tolerance = 1e-2,
                             .any_step = true,
                             .matrix_free = true,
                             .symmetric = true};

}  // namespace pelage
