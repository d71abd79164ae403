#include "run/run.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "base/number.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "time/step_limit.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// Local error per step, relative to the size of the fields, that the adaptive step keeps: spacing and look of finished
/// patterns do not change with it from 1e-2 down.
constexpr double step_tolerance = 1e-2;
/// Steps change by this factor, so that matrices and their factors are seldom refilled.
constexpr double step_factor = std::numbers::sqrt2;
/// A start well inside the stable range of every shipped model.
constexpr double first_step_fraction = 1.0 / 16;
/// With steps below this share of the suggested one, fields grow to infinity in finite time: no step leads beyond.
constexpr double smallest_step_fraction = 1e-9;
/// The residual lies far below the change of one step, which the warm start would otherwise swallow.
constexpr double solver_tolerance = 1e-6;

bool adaptive(const Program& p) { return !p.step && p.stepper == "sbdf2"; }

/// The nonlinear terms need some room below the limit of the linear analysis.
constexpr double share_of_stable_step = 0.8;

/// Amounts are kept to this share whenever the surface moves, far below the error of a step.
constexpr double amount_tolerance = 1e-12;

double find_stable_step(const Program& p, const Operators& operators) {
  if (p.stepper == "sbdf2") return std::numeric_limits<double>::infinity();
  return largest_stable_step(p.model, p.stepper, operators.largest_k2() * p.length_unit * p.length_unit);
}

double first_step(const Program& p, double stable_step) {
  if (p.step) return *p.step;
  if (adaptive(p)) return p.suggested_step * first_step_fraction;
  return std::min(p.suggested_step, share_of_stable_step * stable_step);
}

}  // namespace

Run::Run(Program program, const Progress& progress)
    : program_(std::move(program)),
      operators_(std::make_unique<Operators>(program_, progress)),
      stepper_(make_stepper(program_.stepper)),
      stable_step_(find_stable_step(program_, *operators_)),
      step_(first_step(program_, stable_step_)) {
  if (program_.motion.any()) surface_ = std::make_unique<MovingSurface>(program_.shape, program_.motion);
  state_.now = operators_->initial();
  summary_.step = step_;
  check_stop();
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;

double Run::fraction() const {
  if (done()) return 1;
  double fraction = program_.until > 0 ? state_.time / program_.until : 0;
  if (program_.steps)
    fraction = std::max(fraction, static_cast<double>(state_.step) / static_cast<double>(*program_.steps));
  return std::min(1.0, fraction);
}

/// The error does not see the limit of stability before it is passed, so that the step stays below the model's
/// suggestion. The last step is cut to end on time; a rest below a thousandth of a step is joined to it.
double Run::next_step() const {
  const double rest = program_.until - state_.time;
  return rest < step_ * 1.001 ? rest : step_;
}

const RunSummary& Run::advance(std::int64_t steps) {
  const double smallest_step = smallest_step_fraction * program_.suggested_step;
  for (std::int64_t k = 0; k < steps && !done();) {
    follow_surface(state_.time + next_step());
    operators_->update(state_);
    StepRequest request{.dt = next_step(), .solver_tolerance = solver_tolerance};
    if (adaptive(program_)) request.largest_error = step_tolerance;
    const StepReport report = stepper_->step(operators_->system(), state_, request);
    summary_.iterations += report.iterations;
    if (report.accepted) {
      accept(report);
      ++k;
    } else if (adaptive(program_) && request.dt > smallest_step) {
      ++summary_.rejected;
      step_ = request.dt / 2;
    } else {
      fail(report);
    }
  }
  return summary_;
}

/// Brings surface, matrices and state to the place where the next step, which ends at `time`, finds them. The values of
/// the earlier states ride along as those of the present one, so that the stepper sees a surface at rest:
///   alpha M^(n+1) u^(n+1) + dt D K^(n+1) u^(n+1) = ... M^(n+1) v^n + ... M^(n+1) v^(n-1)
/// with v = u for textures; with M^(n+1) v^n = M^n u^n it is the evolving surface finite element method (Dziuk, Elliott
/// 2007; Barreira, Elliott, Madzvamuse 2011) for d/dt (M u) + D K u = F.
void Run::follow_surface(double time) {
  if (!surface_ || !surface_->advance(state_.step, time)) return;
  const SparseMatrix mass_before = *operators_->system().mass;
  operators_->place(program_, surface_->points());
  if (program_.motion.physical) keep_amounts(mass_before);
  stepper_ = make_stepper(program_.stepper);  // the matrices that it kept are of the old surface
  if (state_.past_rates.empty()) return;
  std::vector<Vector> samples;
  sample_fields(operators_->system(), state_.past[0], samples);
  evaluate_rates(operators_->system(), samples, state_.time - state_.past_steps[0], state_.past_rates);
}

/// Algebraic species follow from the others and have no amount of their own to keep.
void Run::keep_amounts(const SparseMatrix& mass_before) {
  const System& system = operators_->system();
  const auto keep = [&](std::vector<Vector>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (!system.species[i].algebraic)
        fields[i] = solve_spd(*system.mass, mass_before * fields[i], {.tolerance = amount_tolerance});
  };
  keep(state_.now);
  for (std::vector<Vector>& fields : state_.past) keep(fields);
}

std::vector<double> Run::amounts() const {
  const SparseMatrix& mass = *operators_->system().mass;
  const Vector integral = mass * Vector::Ones(mass.rows());
  std::vector<double> amounts;
  for (const Vector& u : state_.now) amounts.push_back(dot(integral, u));
  return amounts;
}

void Run::accept(const StepReport& report) {
  summary_.time = state_.time;
  summary_.steps = state_.step;
  summary_.minimum = report.minimum;
  summary_.maximum = report.maximum;
  summary_.change = report.change;
  // The estimate grows with the third power of the step.
  const double room = step_factor * step_factor * step_factor * 1.2;
  if (adaptive(program_) && state_.past.size() > 1 && report.error * room < step_tolerance)
    step_ = std::min(step_ * step_factor, program_.suggested_step);
  summary_.step = step_;
  check_stop();
}

void Run::check_stop() {
  if (program_.steps && state_.step >= *program_.steps)
    summary_.status = RunStatus::steps_reached;
  else if (state_.time >= program_.until)
    summary_.status = RunStatus::time_reached;
  else if (surface_ && surface_->moving())
    summary_.status = RunStatus::running;
  else if (state_.step > 0 && program_.stationary > 0 && summary_.change < program_.stationary)
    summary_.status = RunStatus::stationary;
}

void Run::fail(const StepReport& report) {
  summary_.status = RunStatus::failed;
  summary_.message = "step " + std::to_string(state_.step + 1) + ", time " + number(state_.time) + ": " +
                     (report.failure.empty() ? "the fields change too fast for the smallest step" : report.failure) + "; " +
                     (program_.step ? "halve the step or leave it to the stepper"
                                    : "check the parameters of the model, or give a smaller --step");
}

CoatFields Run::fields() const {
  CoatFields f;
  f.shape = program_.shape;
  if (surface_) f.shape.points = surface_->points();
  f.levels = operators_->levels();
  f.loop = program_.method == "loop";
  f.control = operators_->control();
  f.wavelength = program_.size;
  for (std::size_t i = 0; i < state_.now.size(); ++i) {
    f.species.push_back(program_.model.species_name(i));
    f.coefficients.emplace_back(state_.now[i].begin(), state_.now[i].end());
  }
  return f;
}

double measured_wavelength(const SparseMatrix& mass, const SparseMatrix& stiffness, const Vector& u) {
  const Vector ones = Vector::Ones(u.size());
  const Vector integral = mass * ones;
  const Vector deviation = u.array() - dot(integral, u) / integral.sum();
  return 2 * std::numbers::pi * std::sqrt(dot(deviation, mass * deviation) / dot(deviation, stiffness * deviation));
}

// --- checkpoints ----------------------------------------------------------------------------------------

namespace {

constexpr char magic[] = "pelage checkpoint 1\n";

class Writer {
 public:
  explicit Writer(std::string& out) : out_(out) {}
  template <class T>
  void number(T value) {
    out_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void fields(const std::vector<Vector>& fields) {
    number(static_cast<std::uint64_t>(fields.size()));
    for (const Vector& f : fields) {
      number(static_cast<std::uint64_t>(f.size()));
      out_.append(reinterpret_cast<const char*>(f.data()), static_cast<std::size_t>(f.size()) * sizeof(double));
    }
  }

 private:
  std::string& out_;
};

/// Points as a field of their coordinates, one after the other.
Vector flattened(const std::vector<Point>& points) {
  Vector flat(static_cast<Eigen::Index>(3 * points.size()));
  for (Eigen::Index i = 0; i < flat.size(); ++i)
    flat[i] = points[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)];
  return flat;
}

std::vector<Point> as_points(const Vector& flat) {
  std::vector<Point> points(static_cast<std::size_t>(flat.size() / 3));
  for (Eigen::Index i = 0; i < flat.size(); ++i)
    points[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)] = flat[i];
  return points;
}

class Reader {
 public:
  explicit Reader(const std::string& in) : in_(in) {}
  void bytes(void* target, std::size_t count) {
    if (count > in_.size() - at_) throw Error(Fault::input, "the checkpoint is cut short");
    std::memcpy(target, in_.data() + at_, count);
    at_ += count;
  }
  template <class T>
  T number() {
    T value;
    bytes(&value, sizeof value);
    return value;
  }
  std::vector<Vector> fields() {
    std::vector<Vector> result(limited(number<std::uint64_t>()));
    for (Vector& f : result) {
      f.resize(static_cast<Eigen::Index>(limited(number<std::uint64_t>())));
      bytes(f.data(), static_cast<std::size_t>(f.size()) * sizeof(double));
    }
    return result;
  }
  bool at_end() const { return at_ == in_.size(); }

 private:
  std::size_t limited(std::uint64_t count) const {  // every element takes at least eight bytes
    if (count > (in_.size() - at_) / sizeof(double)) throw Error(Fault::input, "the checkpoint is damaged");
    return static_cast<std::size_t>(count);
  }
  const std::string& in_;
  std::size_t at_ = 0;
};

bool has_sizes(const std::vector<Vector>& fields, std::size_t count, Eigen::Index size) {
  return fields.size() == count &&
         std::all_of(fields.begin(), fields.end(), [&](const Vector& f) { return f.size() == size; });
}

}  // namespace

std::string Run::checkpoint() const {
  std::string out = magic;
  Writer w(out);
  w.number(state_.time);
  w.number(state_.step);
  w.number(step_);
  w.number(summary_.change);
  w.fields(state_.now);
  w.number(static_cast<std::uint64_t>(state_.past.size()));
  for (std::size_t k = 0; k < state_.past.size(); ++k) {
    w.number(state_.past_steps[k]);
    w.fields(state_.past[k]);
  }
  w.fields(state_.past_rates);
  if (!surface_) return out;
  const MovingSurface::State surface = surface_->state();
  w.number(surface.scale);
  w.number(static_cast<std::uint64_t>(surface.fair_steps));
  w.number(static_cast<std::uint64_t>(surface.fair_done));
  w.fields({flattened(surface.faired)});
  return out;
}

void Run::restore(const std::string& bytes) {
  if (bytes.compare(0, sizeof magic - 1, magic) != 0) throw Error(Fault::input, "this is not a checkpoint");
  const std::string body = bytes.substr(sizeof magic - 1);
  Reader r(body);
  State state;
  state.time = r.number<double>();
  state.step = r.number<std::int64_t>();
  const double step = r.number<double>();
  const double change = r.number<double>();
  state.now = r.fields();
  const auto depth = r.number<std::uint64_t>();
  for (std::uint64_t k = 0; k < depth && k < 2; ++k) {
    state.past_steps.push_back(r.number<double>());
    state.past.push_back(r.fields());
  }
  state.past_rates = r.fields();
  MovingSurface::State surface;
  bool fits = true;
  if (surface_) {
    surface.scale = r.number<double>();
    surface.fair_steps = static_cast<int>(r.number<std::uint64_t>());
    surface.fair_done = r.number<std::uint64_t>() != 0;
    const std::vector<Vector> faired = r.fields();
    fits = has_sizes(faired, 1, 3 * std::ssize(surface_->state().faired)) && surface.scale > 0;
    if (fits) surface.faired = as_points(faired[0]);
  }
  const System& system = operators_->system();
  const auto unknowns = system.mass->rows();
  fits = fits && r.at_end() && has_sizes(state.now, state_.now.size(), unknowns);
  for (const auto& fields : state.past) fits = fits && has_sizes(fields, state_.now.size(), unknowns);
  if (program_.stepper == "sbdf2" && !state.past.empty())
    fits = fits && has_sizes(state.past_rates, state_.now.size(), system.sampling->count());
  if (!fits) throw Error(Fault::input, "the checkpoint belongs to another shape, size or model");
  state_ = std::move(state);
  if (surface_) {
    surface_->restore(std::move(surface));
    operators_->place(program_, surface_->points());
    stepper_ = make_stepper(program_.stepper);
  }
  step_ = step;
  summary_ = {};
  summary_.time = state_.time;
  summary_.steps = state_.step;
  summary_.step = step_;
  summary_.change = change;
  check_stop();
}

}  // namespace pelage
