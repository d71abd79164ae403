#include "run/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/number.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "run/checkpoint.h"
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
/// A stage that takes so many times the steps of the suggested size, and some more for its start, is given up. Shipped
/// models with a parameter at the end of its range take up to 25 times as many.
constexpr double most_steps = 100, few_steps = 1000;
/// The residual lies far below the change of one step, which the warm start would otherwise swallow.
constexpr double solver_tolerance = 1e-6;

bool adaptive(const Program& p) { return !p.step && p.stepper == "sbdf2"; }

/// The nonlinear terms need some room below the limit of the linear analysis.
constexpr double share_of_stable_step = 0.8;

/// Amounts are kept to this share whenever the surface moves, far below the error of a step.
constexpr double amount_tolerance = 1e-12;

/// Largest step that linear analysis allows the "paper" and "explicit" steppers [model time]; infinite for others.
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

Run::Run(Program program, const Progress& progress) : Run(std::vector<Program>{std::move(program)}, progress) {}

Run::Run(std::vector<Program> stages, const Progress& progress) : stages_(std::move(stages)) {
  if (program().motion.any()) surface_ = std::make_unique<MovingSurface>(program().shape, program().motion);
  begin_stage(progress);
}

void Run::begin_stage(const Progress& progress) {
  operators_ = std::make_unique<Operators>(program(), progress);
  stepper_ = make_stepper(program().stepper);
  const double stable_step = find_stable_step(program(), *operators_);
  step_ = first_step(program(), stable_step);
  state_ = {};
  state_.now = operators_->initial();
  summary_ = {};
  summary_.step = step_;
  warn_about_stage(stable_step);
  check_stop();
}

void Run::warn_about_stage(double stable_step) {
  const std::string stage = stages_.size() > 1 ? "stage " + program().name + ": " : "";
  if (step_ > stable_step)
    warnings_.push_back(stage + "the step " + number(step_) + " is beyond " + number(stable_step) +
                        ", the largest that is stable for " + program().stepper +
                        "; what grows may be an artefact of the step");
  for (const std::string& text : operators_->warnings()) warnings_.push_back(stage + text);
}

void Run::next_stage() {
  finished_.push_back({std::move(state_.now), summary_});
  enter_stage(stage_ + 1, surface_ ? surface_->points() : program().shape.points);
}

/// The stage `number` on the mesh of the present one, with the fields of all finished stages.
void Run::enter_stage(std::size_t number, std::vector<Point> points) {
  Program& next = stages_[number];
  if (number != stage_) next.shape = std::move(stages_[stage_].shape);
  next.shape.points = std::move(points);
  next.levels = operators_->levels();
  next.fields.clear();
  const SparseMatrix& at_vertices = operators_->discretisation().values;
  for (std::size_t k = 0; k < finished_.size(); ++k)
    for (std::size_t i = 0; i < finished_[k].fields.size(); ++i) {
      const Vector values = at_vertices * finished_[k].fields[i];
      next.fields[field_name(stages_[k].name, stages_[k].model.species_name(i))] = {values.begin(), values.end()};
    }
  stage_ = number;
  begin_stage({});
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;

bool Run::done() const {
  return summary_.status == RunStatus::failed || (stage_done() && stage_ + 1 == stages_.size());
}

double Run::fraction() const {
  if (done()) return 1;
  double fraction = program().until > 0 ? state_.time / program().until : 0;
  if (program().steps)
    fraction = std::max(fraction, static_cast<double>(state_.step) / static_cast<double>(*program().steps));
  if (stage_done()) fraction = 1;
  return (static_cast<double>(stage_) + std::min(1.0, fraction)) / static_cast<double>(stages_.size());
}

/// The error does not see the limit of stability before it is passed, so that the step stays below the model's
/// suggestion. The last step is cut to end on time; a rest below a thousandth of a step is joined to it.
double Run::next_step() const {
  const double rest = program().until - state_.time;
  return rest < step_ * 1.001 ? rest : step_;
}

const RunSummary& Run::advance(std::int64_t steps) {
  for (std::int64_t k = 0; k < steps && !done();) {
    if (stage_done()) {
      next_stage();
      continue;
    }
    follow_surface(state_.time + next_step());
    operators_->update(state_);
    StepRequest request{.dt = next_step(), .solver_tolerance = solver_tolerance};
    if (adaptive(program())) request.largest_error = step_tolerance;
    const StepReport report = stepper_->step(operators_->system(), state_, request);
    summary_.iterations += report.iterations;
    if (report.accepted) {
      accept(report, request.dt);
      ++k;
      if (takes_too_long())
        fail("the fields change so fast that the step is " + number(step_) + ", far below the model's of " +
             number(program().suggested_step));
    } else if (adaptive(program()) && request.dt > smallest_step_fraction * program().suggested_step) {
      ++summary_.rejected;
      step_ = request.dt / 2;
    } else {
      fail(report.failure.empty() ? "the fields change too fast for the smallest step" : report.failure);
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
  std::int64_t steps = state_.step;
  for (const FinishedStage& stage : finished_) {
    steps += stage.summary.steps;
    time += stage.summary.time;
  }
  if (!surface_ || !surface_->advance(steps, time)) return;
  const SparseMatrix mass_before = *operators_->system().mass;
  operators_->place(program(), surface_->points());
  if (program().motion.physical) keep_amounts(mass_before);
  stepper_ = make_stepper(program().stepper);  // the matrices that it kept are of the old surface
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

void Run::accept(const StepReport& report, double dt) {
  summary_.time = state_.time;
  summary_.steps = state_.step;
  summary_.minimum = report.minimum;
  summary_.maximum = report.maximum;
  // A step that the end cuts short divides what the solver leaves by little time.
  if (2 * dt >= step_ || state_.step == 1) summary_.change = report.change;
  // The estimate grows with the third power of the step.
  const double room = step_factor * step_factor * step_factor * 1.2;
  if (adaptive(program()) && state_.past.size() > 1 && report.error * room < step_tolerance)
    step_ = std::min(step_ * step_factor, program().suggested_step);
  summary_.step = step_;
  check_stop();
}

void Run::check_stop() {
  if (program().steps && state_.step >= *program().steps)
    summary_.status = RunStatus::steps_reached;
  else if (state_.time >= program().until)
    summary_.status = RunStatus::time_reached;
  else if (surface_ && surface_->moving())
    summary_.status = RunStatus::running;
  else if (state_.step > 0 && program().stationary > 0 && summary_.change < program().stationary)
    summary_.status = RunStatus::stationary;
}

/// Whether steps of the size that the stepper found will not reach the end in any sensible time.
bool Run::takes_too_long() const {
  const double suggested = program().until / program().suggested_step;
  return adaptive(program()) && summary_.status == RunStatus::running &&
         static_cast<double>(state_.step) > most_steps * suggested + few_steps;
}

void Run::fail(const std::string& reason) {
  summary_.status = RunStatus::failed;
  summary_.message = (stages_.size() > 1 ? "stage " + program().name + ", step " : "step ") +
                     std::to_string(state_.step + 1) + ", time " + number(state_.time) + ": " + reason + "; " +
                     (program().step ? "halve the step or leave it to the stepper"
                                     : "check the parameters of the model, or give a smaller --step");
}

CoatFields Run::fields() const {
  CoatFields f;
  f.shape = program().shape;
  if (surface_) f.shape.points = surface_->points();
  f.textures = program().textures;
  f.levels = operators_->levels();
  f.loop = program().method == "loop";
  f.control = operators_->control();
  f.wavelength = program().size;
  for (const Program& stage : stages_) f.wavelength = std::min(f.wavelength, stage.size);
  const auto add = [&](const std::string& name, const Vector& u) {
    f.species.push_back(name);
    f.coefficients.emplace_back(u.begin(), u.end());
  };
  for (std::size_t k = 0; k < finished_.size(); ++k)
    for (std::size_t i = 0; i < finished_[k].fields.size(); ++i)
      add(field_name(stages_[k].name, stages_[k].model.species_name(i)), finished_[k].fields[i]);
  for (std::size_t i = 0; i < state_.now.size(); ++i) add(program().model.species_name(i), state_.now[i]);
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

constexpr char magic[] = "pelage checkpoint 2\n";
constexpr const char* foreign = "the checkpoint belongs to another shape, size, model or recipe";

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

bool has_sizes(const std::vector<Vector>& fields, std::size_t count, Eigen::Index size) {
  return fields.size() == count &&
         std::all_of(fields.begin(), fields.end(), [&](const Vector& f) { return f.size() == size; });
}

}  // namespace

std::string Run::checkpoint() const {
  std::string out = magic;
  CheckpointWriter w(out);
  w.number(state_.time);
  w.number(state_.step);
  w.number(step_);
  w.number(summary_.change);
  w.number(static_cast<std::uint64_t>(stage_));
  for (const FinishedStage& stage : finished_) {
    w.number(static_cast<std::uint64_t>(stage.summary.status));
    w.number(stage.summary.time);
    w.number(stage.summary.steps);
    w.fields(stage.fields);
  }
  w.fields(state_.now);
  w.number(static_cast<std::uint64_t>(state_.past.size()));
  for (std::size_t k = 0; k < state_.past.size(); ++k) {
    w.number(state_.past_steps[k]);
    w.fields(state_.past[k]);
  }
  w.fields(state_.past_rates);
  if (!surface_) return out;
  const MovingSurface::State surface = surface_->state();
  w.fields({flattened(program().shape.points)});  // where the stage began
  w.number(surface.scale);
  w.number(static_cast<std::uint64_t>(surface.fair_steps));
  w.number(static_cast<std::uint64_t>(surface.fair_done));
  w.fields({flattened(surface.faired)});
  return out;
}

/// What a checkpoint holds.
struct Run::Snapshot {
  State state;
  double step = 0, change = 0;
  std::size_t stage = 0;
  std::vector<FinishedStage> finished;
  std::vector<Vector> start, faired;  ///< points
  MovingSurface::State surface;
};

/// Error(Fault::input) when the bytes end early, go on for too long, or speak of a stage that this run does not have.
Run::Snapshot Run::read_snapshot(const std::string& bytes) const {
  if (bytes.compare(0, sizeof magic - 1, magic) != 0) throw Error(Fault::input, "this is not a checkpoint");
  const std::string body = bytes.substr(sizeof magic - 1);
  CheckpointReader r(body);
  Snapshot s;
  s.state.time = r.number<double>();
  s.state.step = r.number<std::int64_t>();
  s.step = r.number<double>();
  s.change = r.number<double>();
  s.stage = static_cast<std::size_t>(r.number<std::uint64_t>());
  if (s.stage >= stages_.size()) throw Error(Fault::input, foreign);
  for (std::size_t k = 0; k < s.stage; ++k) {
    FinishedStage& stage = s.finished.emplace_back();
    stage.summary.status = static_cast<RunStatus>(r.number<std::uint64_t>());
    stage.summary.time = r.number<double>();
    stage.summary.steps = r.number<std::int64_t>();
    stage.fields = r.fields();
  }
  s.state.now = r.fields();
  const auto depth = r.number<std::uint64_t>();
  for (std::uint64_t k = 0; k < depth && k < 2; ++k) {
    s.state.past_steps.push_back(r.number<double>());
    s.state.past.push_back(r.fields());
  }
  s.state.past_rates = r.fields();
  if (surface_) {
    s.start = r.fields();
    s.surface.scale = r.number<double>();
    s.surface.fair_steps = static_cast<int>(r.number<std::uint64_t>());
    s.surface.fair_done = r.number<std::uint64_t>() != 0;
    s.faired = r.fields();
  }
  if (!r.at_end()) throw Error(Fault::input, foreign);
  return s;
}

/// Whether all sizes are those of this run.
bool Run::fits(const Snapshot& s) const {
  const auto unknowns = operators_->system().mass->rows();
  const std::size_t species = stages_[s.stage].model.species_count();
  bool fits = has_sizes(s.state.now, species, unknowns);
  for (const auto& fields : s.state.past) fits = fits && has_sizes(fields, species, unknowns);
  for (std::size_t k = 0; k < s.finished.size(); ++k)
    fits = fits && has_sizes(s.finished[k].fields, stages_[k].model.species_count(), unknowns);
  if (program().stepper == "sbdf2" && !s.state.past.empty())  // which samples at the vertices
    fits = fits && has_sizes(s.state.past_rates, species, unknowns);
  if (!surface_) return fits;
  return fits && s.surface.scale > 0 && has_sizes(s.start, 1, 3 * std::ssize(program().shape.points)) &&
         has_sizes(s.faired, 1, 3 * std::ssize(surface_->state().faired));
}

void Run::restore(const std::string& bytes) {
  Snapshot s = read_snapshot(bytes);
  if (!fits(s)) throw Error(Fault::input, foreign);
  finished_ = std::move(s.finished);
  if (s.stage != stage_ || surface_) {
    warnings_.clear();
    enter_stage(s.stage, surface_ ? as_points(s.start[0]) : program().shape.points);
  }
  state_ = std::move(s.state);
  if (surface_) {
    s.surface.faired = as_points(s.faired[0]);
    surface_->restore(std::move(s.surface));
    operators_->place(program(), surface_->points());
    stepper_ = make_stepper(program().stepper);
  }
  step_ = s.step;
  summary_ = {};
  summary_.time = state_.time;
  summary_.steps = state_.step;
  summary_.step = step_;
  summary_.change = s.change;
  check_stop();
}

}  // namespace pelage
