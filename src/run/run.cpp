#include "run/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/box.h"
#include "base/number.h"
#include "base/report.h"
#include "pelage/error.h"
#include "react/stability.h"
#include "run/blow_up.h"
#include "run/checkpoint.h"
#include "time/step_limit.h"
#include "time/step_support.h"

namespace pelage {

const char* name_of(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::time_reached:
      return "time_reached";
    case RunStatus::steps_reached:
      return "steps_reached";
    case RunStatus::stationary:
      return "stationary";
    case RunStatus::failed:
      break;
  }
  return "failed";
}

namespace {

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

/// The nonlinear terms need some room below the limit of the linear analysis.
constexpr double share_of_stable_step = 0.8;

/// Amounts are kept to this share whenever the surface moves, far below the error of a step.
constexpr double amount_tolerance = 1e-12;

/// Largest step that linear analysis allows [model time]; infinite where the error tells.
double find_stable_step(const StageProgram& p, const System& system, const Space& space) {
  if (p.stepper->adaptive || !system.mass) return std::numeric_limits<double>::infinity();
  const double k2 = largest_k2(*system.mass, *space.stiffness());
  return largest_stable_step(p.model, *p.stepper, k2 * p.length_unit * p.length_unit);
}

/// Where the error does not see the limit of stability before it is passed, the step stays below the model's
/// suggestion. Others may settle on long steps, but not on so few that the end of the run is seen by chance.
double longest_step(const StageProgram& p) {
  constexpr double fewest_steps = 50;
  return p.stepper->any_step ? std::max(p.suggested_step, p.until / fewest_steps) : p.suggested_step;
}

/// After an accepted step. The estimate of the error grows with the third power of the step.
double next_adaptive_step(const StageProgram& p, double tolerance, double step, double error) {
  if (p.stepper->any_step) {
    constexpr double safety = 0.8, most = 2;
    return std::min(step * std::clamp(safety * std::cbrt(tolerance / error), 1 / most, most), longest_step(p));
  }
  const double room = step_factor * step_factor * step_factor * 1.2;
  return error * room < tolerance ? std::min(step * step_factor, longest_step(p)) : step;
}

double first_step(const StageProgram& p, double stable_step) {
  if (p.step) return *p.step;
  if (p.adaptive()) return p.suggested_step * first_step_fraction;
  return std::min(p.suggested_step, share_of_stable_step * stable_step);
}

void warn_of_anisotropy(const std::string& label, const Method& method, const StageProgram& p,
                        const StageSystem& equations, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < p.model.species_count(); ++i) {
    if (!p.model.anisotropic(i) && !p.model.has_tensor(i)) continue;
    constexpr double rounding = 1e-9;  // of the eigenvalues of tensors
    if (const double ratio = equations.anisotropy(i); ratio > method.safe_anisotropy * (1 + rounding))
      warnings.push_back(label + "the rates of " + p.model.species_name(i) + " along and across differ " +
                         number(ratio) + " times; above " + number(method.safe_anisotropy) + " times, with --method " +
                         std::string(method.name) + ", the mesh itself begins to show in the stripes");
  }
}

void refuse(const StageProgram& p, const std::string& why, RunSummary& summary) {
  summary.status = RunStatus::failed;
  summary.message = "the stepper \"" + std::string(p.stepper->name) + "\" cannot grow \"" + p.model.name() +
                    "\" here: " + why + "; leave the stepper out";
}

bool same_species(const Model& a, const Model& b) {
  if (a.species_count() != b.species_count()) return false;
  for (std::size_t i = 0; i < a.species_count(); ++i)
    if (a.species_name(i) != b.species_name(i)) return false;
  return true;
}

double magnitude(const Vector& u) { return u.size() > 0 ? std::max(std::abs(minimum(u)), std::abs(maximum(u))) : 0; }

}  // namespace

/// Where a stage ends: at a model time, after so many steps, at rest (StageProgram).
struct Run::Stop {
  double until = 0;
  std::optional<std::int64_t> steps;
  double stationary = 0;
};

/// A stage in progress.
struct Run::Stage {
  std::vector<Point> began_at;  ///< the vertices of the shape, if it moves
  std::shared_ptr<const Material> material;
  StageSystem equations;
  std::unique_ptr<Stepper> stepper;
  State state;
  std::vector<Vector> shown;            ///< state.now with the species that follow; empty where none does
  std::vector<double> first_magnitude;  ///< per species
  double step = 0;
  Stop stop;
  RunSummary summary;
};

Run::Run(Program program, const Progress& progress)
    : program_(std::make_shared<const Program>(std::move(program))),
      world_(program_, progress),
      progress_(progress),
      warnings_(program_->warnings) {
  now_ = begin(0, world_, finished_, warnings_);
}

Run::Run(std::shared_ptr<const Program> program, World world, const Progress& progress)
    : program_(std::move(program)), world_(std::move(world)), progress_(progress), warnings_(program_->warnings) {
  now_ = begin(0, world_, finished_, warnings_);
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;

std::unique_ptr<Run::Stage> Run::begin(std::size_t index, const World& world,
                                       const std::vector<FinishedStage>& finished,
                                       std::vector<std::string>& warnings) const {
  const StageProgram& p = program_->stages[index];
  const std::string label = program_->stages.size() > 1 ? "stage " + p.name + ": " : "";
  report(progress_, label + "assembling", 0.4);
  if (!p.stepper->matrix_free || !world.space().lattice()) world.space().stiffness();
  report(progress_, label + "sampling", 0.8);
  auto material =
      std::make_shared<const Material>(make_material(*program_, p, world, finished_fields(world.space(), finished)));
  StageSystem equations(p, world.shared_space(), material);
  const double stable_step = find_stable_step(p, equations.system(), world.space());
  const double step = first_step(p, stable_step);
  if (step > stable_step)
    warnings.push_back(label + "the step " + number(step) + " is beyond " + number(stable_step) +
                       ", the largest that is stable for " + std::string(p.stepper->name) +
                       "; what grows may be an artefact of the step");
  warn_of_anisotropy(label, *program_->method, p, equations, warnings);
  State state;
  state.now = equations.initial();
  std::vector<double> first;
  for (const Vector& u : state.now) first.push_back(magnitude(u));
  auto stage = std::make_unique<Stage>(Stage{world.surface() ? world.points() : std::vector<Point>{},
                                             std::move(material),
                                             std::move(equations),
                                             p.stepper->make(),
                                             std::move(state),
                                             {},
                                             std::move(first),
                                             step,
                                             {p.until, p.steps, p.stationary},
                                             {}});
  stage->summary.step = step;
  check_stop(world, *stage);
  return stage;
}

/// The finished fields at the nodes of the space, by name.
VertexAttributes Run::finished_fields(const Space& space, const std::vector<FinishedStage>& finished) const {
  VertexAttributes fields;
  for (std::size_t k = 0; k < finished.size(); ++k)
    for (std::size_t i = 0; i < finished[k].fields.size(); ++i) {
      const StageProgram& p = program_->stages[k];
      const Vector values = space.node_values() * finished[k].fields[i];
      fields[field_name(p.name, p.model.species_name(i))] = {values.begin(), values.end()};
    }
  return fields;
}

void Run::next_stage() {
  std::vector<FinishedStage> finished = finished_;
  finished.push_back({coefficients(), now_->summary});
  now_ = begin(stage_ + 1, world_, finished, warnings_);
  finished_ = std::move(finished);
  ++stage_;
}

bool Run::done() const {
  const RunStatus status = now_->summary.status;
  return status == RunStatus::failed || (status != RunStatus::running && stage_ + 1 == program_->stages.size());
}

const RunSummary& Run::summary() const { return now_->summary; }
const System& Run::system() const { return now_->equations.system(); }
const std::vector<Vector>& Run::coefficients() const { return now_->shown.empty() ? now_->state.now : now_->shown; }
std::vector<Vector> Run::initial() const { return now_->equations.initial(); }

void Run::set_coefficients(std::vector<Vector> coefficients) {
  now_->state.now = std::move(coefficients);
  now_->state.past.clear();
  now_->state.past_steps.clear();
  now_->state.past_rates.clear();
  for (std::size_t i = 0; i < now_->state.now.size(); ++i) {
    Vector& u = now_->state.now[i];
    now_->first_magnitude[i] = std::max(now_->first_magnitude[i], magnitude(u));
  }
  show_followers();
}

void Run::set_values(std::size_t species, const Vector& values) {
  std::vector<Vector> all = coefficients();
  const SampledMass nodes = space().sampled(SampleRule::vertices);
  all[species] = nodes.mass ? coefficients_from_samples(*nodes.sampling, *nodes.mass, values) : values;
  set_coefficients(std::move(all));
}

void Run::go_on() {
  if (!done() || now_->summary.status == RunStatus::failed) return;
  now_->stop = {now_->state.time + stage_program().until, {}, 0};
  now_->summary.status = RunStatus::running;
}

bool Run::take_over(const Run& other) {
  if (other.space().unknowns() != space().unknowns() || other.world_.surface() || world_.surface()) return false;
  if (other.program_->stages.size() != program_->stages.size()) return false;
  for (std::size_t k = 0; k <= other.stage_; ++k)
    if (!same_species(other.program_->stages[k].model, program_->stages[k].model)) return false;
  std::vector<std::string> warnings = program_->warnings;
  std::unique_ptr<Stage> stage = begin(other.stage_, world_, other.finished_, warnings);
  stage->state.time = stage->summary.time = other.now_->state.time;
  stage->state.step = stage->summary.steps = other.now_->state.step;
  stage_ = other.stage_;
  finished_ = other.finished_;
  now_ = std::move(stage);
  warnings_ = std::move(warnings);
  set_coefficients(other.now_->state.now);
  check_stop(world_, *now_);
  return true;
}

double Run::stage_fraction() const {
  // Rest may come earlier or later than it did when it was measured.
  constexpr double nearly_done = 0.98;
  const StageProgram& p = stage_program();
  const Stop& stop = now_->stop;
  const RunSummary& summary = now_->summary;
  if (summary.status != RunStatus::running) return 1;
  double fraction = stop.until > 0 ? now_->state.time / stop.until : 0;
  if (stop.steps)
    fraction = std::max(fraction, static_cast<double>(now_->state.step) / static_cast<double>(*stop.steps));
  if (p.iterations)
    fraction = std::max(fraction, std::min(nearly_done, static_cast<double>(summary.iterations) / *p.iterations));
  return std::min(1.0, fraction);
}

double Run::fraction() const {
  if (done()) return 1;
  const std::vector<StageProgram>& stages = program_->stages;
  const bool known = std::ranges::all_of(stages, [](const StageProgram& p) { return p.iterations.has_value(); });
  double before = 0, all = 0;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const double work = known ? *stages[k].iterations : 1;
    if (k < stage_) before += work;
    if (k == stage_) before += work * stage_fraction();
    all += work;
  }
  return before / all;
}

/// The last step is cut to end on time; a rest below a thousandth of a step is joined to it.
double Run::next_step() const {
  const double rest = now_->stop.until - now_->state.time;
  return rest < now_->step * 1.001 ? rest : now_->step;
}

const RunSummary& Run::advance(std::int64_t steps) {
  for (std::int64_t k = 0; k < steps && !done();) {
    if (now_->summary.status != RunStatus::running) {
      show_followers();
      next_stage();
      continue;
    }
    const StageProgram& p = stage_program();
    follow_surface(now_->state.time + next_step());
    now_->equations.update(now_->state);
    StepRequest request{
        .dt = next_step(), .solver_tolerance = solver_tolerance, .solver = p.solver, .refresh = p.refresh};
    if (p.adaptive()) request.largest_error = step_tolerance();
    const StepReport report = now_->stepper->step(system(), now_->state, request);
    now_->summary.iterations += report.iterations;
    now_->summary.bytes += report.bytes;
    now_->summary.solves += report.solves;
    now_->summary.indefinite += report.indefinite;
    now_->summary.solve_seconds += report.solve_seconds;
    if (report.accepted) {
      accept(report, request.dt);
      ++k;
      if (takes_too_long())
        fail("the fields change so fast that the step is " + number(now_->step) + ", far below the model's of " +
                 number(p.suggested_step),
             {});
    } else if (report.refused) {
      refuse(p, report.failure, now_->summary);
    } else if (p.adaptive() && request.dt > smallest_step_fraction * p.suggested_step) {
      ++now_->summary.rejected;
      now_->step = request.dt / 2;
    } else {
      fail(report.failure.empty() ? "the fields change too fast for the smallest step" : report.failure,
           report.runaway);
    }
  }
  show_followers();
  return now_->summary;
}

/// No step needs these species: they are found for those who look.
void Run::show_followers() {
  if (std::ranges::none_of(system().species, &Species::follows)) return;
  now_->shown = now_->state.now;
  follow(system(), now_->state.time, now_->shown);
  RunSummary& summary = now_->summary;
  for (std::size_t i = 0; i < coefficients().size(); ++i) {
    if (!system().species[i].follows) continue;
    summary.minimum = std::min(summary.minimum, minimum(coefficients()[i]));
    summary.maximum = std::max(summary.maximum, maximum(coefficients()[i]));
  }
}

/// Brings surface, matrices and state to the place where the next step, which ends at `time`, finds them. The values of
/// the earlier states ride along as those of the present one, so that the stepper sees a surface at rest:
///   alpha M^(n+1) u^(n+1) + dt D K^(n+1) u^(n+1) = ... M^(n+1) v^n + ... M^(n+1) v^(n-1)
/// with v = u for textures; with M^(n+1) v^n = M^n u^n it is the evolving surface finite element method (Dziuk, Elliott
/// 2007; Barreira, Elliott, Madzvamuse 2011) for d/dt (M u) + D K u = F.
void Run::follow_surface(double time) {
  State& state = now_->state;
  std::int64_t steps = state.step;
  for (const FinishedStage& stage : finished_) {
    steps += stage.summary.steps;
    time += stage.summary.time;
  }
  if (!world_.follow(steps, time)) return;
  const SharedMatrix mass_before = system().mass;
  now_->equations = StageSystem(stage_program(), world_.shared_space(), now_->material);
  if (program_->motion.physical) keep_amounts(*mass_before);
  if (!stage_program().stepper->keeps_rates) state.past_rates.clear();
  if (state.past_rates.empty()) return;
  std::vector<Vector> samples;
  sample_fields(system(), state.past[0], samples);
  const double before = state.time - state.past_steps[0];
  evaluate_rates(system(), samples, before, state.past_rates);
  if (!system().fluxes) return;
  const std::vector<Vector> fluxes = system().fluxes(state.past[0], before);
  state.past_rates.insert(state.past_rates.end(), fluxes.begin(), fluxes.end());
}

/// Algebraic species follow from the others and have no amount of their own to keep.
void Run::keep_amounts(const SparseMatrix& mass_before) {
  const auto keep = [&](std::vector<Vector>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (!system().species[i].algebraic)
        fields[i] = solve_spd(*system().mass, mass_before * fields[i], {.tolerance = amount_tolerance});
  };
  keep(now_->state.now);
  for (std::vector<Vector>& fields : now_->state.past) keep(fields);
}

std::vector<double> Run::amounts() const {
  const Vector integral =
      system().mass ? Vector(*system().mass * Vector::Ones(system().mass->rows())) : system().sampling->weight;
  std::vector<double> amounts;
  for (const Vector& u : coefficients()) amounts.push_back(dot(integral, u));
  return amounts;
}

/// Relative to the size of the fields. Spacing and look of finished patterns do not change with less.
double Run::step_tolerance() const {
  const StageProgram& p = stage_program();
  return program_->step_error * (p.model.jumps() ? p.stepper->jump_tolerance : p.stepper->tolerance);
}

void Run::accept(const StepReport& report, double dt) {
  RunSummary& summary = now_->summary;
  summary.time = now_->state.time;
  summary.steps = now_->state.step;
  summary.minimum = report.minimum;
  summary.maximum = report.maximum;
  // A step that the end cuts short divides what the solver leaves by little time.
  if (2 * dt >= now_->step || now_->state.step == 1) summary.change = report.change;
  const StageProgram& p = stage_program();
  if (p.adaptive() && now_->state.step > 1)
    now_->step = next_adaptive_step(p, step_tolerance(), now_->step, report.error);
  summary.step = now_->step;
  check_stop(world_, *now_);
}

void Run::check_stop(const World& world, Stage& stage) {
  const Stop& stop = stage.stop;
  RunSummary& summary = stage.summary;
  if (stop.steps && stage.state.step >= *stop.steps)
    summary.status = RunStatus::steps_reached;
  else if (stage.state.time >= stop.until)
    summary.status = RunStatus::time_reached;
  else if (world.surface() && world.surface()->moving())
    summary.status = RunStatus::running;
  else if (stage.state.step > 0 && stop.stationary > 0 && summary.change < stop.stationary)
    summary.status = RunStatus::stationary;
}

/// Whether steps of the size that the stepper found will not reach the end in any sensible time.
bool Run::takes_too_long() const {
  const StageProgram& p = stage_program();
  const double suggested = now_->stop.until / p.suggested_step;
  return p.adaptive() && now_->summary.status == RunStatus::running &&
         static_cast<double>(now_->state.step) > most_steps * suggested + few_steps;
}

/// `runaway`: the value that stopped it, where it was one.
void Run::fail(const std::string& reason, const std::optional<Runaway>& runaway) {
  const StageProgram& p = stage_program();
  const State& state = now_->state;
  const Culprit culprit = find_culprit(system(), state, state.time + next_step(), now_->first_magnitude, runaway);
  RunSummary& summary = now_->summary;
  summary.status = RunStatus::failed;
  summary.message = (program_->stages.size() > 1 ? "stage " + p.name + ", step " : "step ") +
                    std::to_string(state.step + 1) + ", time " + number(state.time) + ": " + reason + "; " +
                    culprit.words + " at " + place_in_words(world_, culprit.at.unknown) + "; " + remedy(culprit.at);
}

std::string Run::remedy(const Runaway& at) const {
  const StageProgram& p = stage_program();
  if (const std::string text = remedy_for_negative(system(), initial(), now_->state.now, at); !text.empty())
    return text + (p.step ? ", or halve the step" : "");
  if (std::isnan(at.value)) return "look for a division by 0, or a root, power or logarithm of less than 0";
  if (p.step) return "halve the step or leave it to the stepper";
  return "check the signs of its rate and the parameters, begin nearer to a steady state, or bound it by max" +
         std::string(p.adaptive() ? "" : "; or give a smaller --step");
}

double Run::contrast(std::size_t i) const {
  const Vector& u = coefficients()[i];
  const double scale = std::max(now_->first_magnitude[i], magnitude(u));
  return scale > 0 ? (maximum(u) - minimum(u)) / scale : 0;
}

bool Run::uniform() const {
  for (std::size_t i = 0; i < coefficients().size(); ++i)
    if (contrast(i) >= uniform_contrast) return false;
  return true;
}

std::string Run::why_uniform() const {
  constexpr double dead_share = 1e-3;
  const StageProgram& p = stage_program();
  if (summary().status == RunStatus::steps_reached)
    return "it was stopped after " + std::to_string(summary().steps) + " steps";
  for (std::size_t i = 0; i < coefficients().size(); ++i)
    if (magnitude(coefficients()[i]) < dead_share * now_->first_magnitude[i])
      return p.model.species_name(i) + " has died out";
  if (const double diagonal = box_of(world_.points()).diagonal(); diagonal > 0 && p.size_known && p.size > diagonal)
    return "a wavelength of " + number(p.size) + " does not fit on a shape of " + number(diagonal);
  if (const Stability s = analyse(p.model); !s.steady_states.empty() && !s.band_max)
    return "by linear theory no wave grows at these parameters";
  return "what has grown is fainter than " + number(100 * uniform_contrast) + " %";
}

CoatFields Run::fields() const {
  CoatFields f;
  f.shape = program_->shape;
  f.nodes = program_->nodes;
  f.period = stage_program().period;
  f.textures = program_->textures;
  f.hierarchy = world_.hierarchy();
  f.method = program_->method;
  f.space = world_.shared_space();
  f.mesh = world_.mesh();
  if (!as<Grid>(f.nodes)) {
    f.points = world_.points();
    f.surface = world_.filled_surface();
    f.control = world_.control();
    f.initial_control = world_.initial_control();
  }
  f.length_unit = stage_program().length_unit;
  f.origin = stage_program().origin;
  f.seed = stage_program().seed;
  f.wavelength = std::ranges::min(program_->stages, {}, &StageProgram::size).size;
  const auto add = [&](const std::string& name, const Vector& u) {
    f.species.push_back(name);
    f.coefficients.emplace_back(u.begin(), u.end());
  };
  for (std::size_t k = 0; k < finished_.size(); ++k)
    for (std::size_t i = 0; i < finished_[k].fields.size(); ++i)
      add(field_name(program_->stages[k].name, program_->stages[k].model.species_name(i)), finished_[k].fields[i]);
  for (std::size_t i = 0; i < coefficients().size(); ++i) add(stage_program().model.species_name(i), coefficients()[i]);
  f.uniform = uniform_species();
  return f;
}

std::vector<char> Run::uniform_species() const {
  std::vector<char> uniform;
  for (const FinishedStage& stage : finished_) uniform.resize(uniform.size() + stage.fields.size(), false);
  for (std::size_t i = 0; i < coefficients().size(); ++i) uniform.push_back(contrast(i) < uniform_contrast);
  return uniform;
}

double measured_wavelength(const SparseMatrix& mass, const SparseMatrix& stiffness, const Vector& u) {
  const Vector ones = Vector::Ones(u.size());
  const Vector integral = mass * ones;
  const Vector deviation = u.array() - dot(integral, u) / sum(integral);
  return 2 * std::numbers::pi * std::sqrt(dot(deviation, mass * deviation) / dot(deviation, stiffness * deviation));
}

// --- checkpoints ----------------------------------------------------------------------------------------

namespace {

constexpr std::string_view magic = "pelage checkpoint 5\n";
constexpr std::string_view kind = "pelage checkpoint ";
constexpr const char* foreign =
    "the checkpoint belongs to another run: shape, recipe, size, seed and options must be the same";

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
  return fields.size() == count && std::ranges::all_of(fields, [&](const Vector& f) { return f.size() == size; });
}

/// Behind the beginning.
CheckpointReader open_checkpoint(const std::string& bytes) {
  if (!bytes.starts_with(magic))
    throw Error(Fault::input, bytes.starts_with(kind) ? "this is a checkpoint of another version of the program"
                                                      : "this is no checkpoint");
  if (!is_sealed(bytes)) throw Error(Fault::input, "the checkpoint is damaged or cut short");
  return CheckpointReader(bytes, magic.size());
}

}  // namespace

std::string note_of_checkpoint(const std::string& bytes) { return open_checkpoint(bytes).text(); }

std::string Run::checkpoint(std::string_view note) const {
  const State& state = now_->state;
  std::string out(magic);
  CheckpointWriter w(out);
  w.text(note);
  w.traits(traits_of(*program_));
  w.number(state.time);
  w.number(state.step);
  w.number(now_->step);
  w.number(now_->summary.change);
  w.number(std::uint64_t{stage_});
  for (const FinishedStage& stage : finished_) {
    w.number(static_cast<std::uint64_t>(stage.summary.status));
    w.number(stage.summary.time);
    w.number(stage.summary.steps);
    w.fields(stage.fields);
  }
  w.fields(state.now);
  w.number(std::uint64_t{state.past.size()});
  for (std::size_t k = 0; k < state.past.size(); ++k) {
    w.number(state.past_steps[k]);
    w.fields(state.past[k]);
  }
  w.fields(state.past_rates);
  if (!world_.surface()) return seal(std::move(out));
  const MovingSurface::State surface = world_.surface()->state();
  w.fields({flattened(now_->began_at)});
  w.number(surface.scale);
  w.number(std::int64_t{surface.fairing.steps});
  w.number(std::uint64_t{surface.fairing.done});
  w.number(std::uint64_t{surface.fairing.kept});
  w.fields({flattened(surface.fairing.points)});
  return seal(std::move(out));
}

/// What a checkpoint holds.
struct Run::Snapshot {
  State state;
  double step = 0, change = 0;
  std::size_t stage = 0;
  std::vector<FinishedStage> finished;
  std::vector<Vector> began_at, faired;  ///< points
  MovingSurface::State surface;
};

/// Error(Fault::input) when the bytes end early, go on for too long, or belong to another program.
Run::Snapshot Run::read_snapshot(const std::string& bytes) const {
  CheckpointReader r = open_checkpoint(bytes);
  r.text();  // the note
  if (const std::string other = difference(r.traits(), traits_of(*program_)); !other.empty())
    throw Error(Fault::input, "the checkpoint belongs to another run: it has " + other);
  Snapshot s;
  s.state.time = r.number();
  s.state.step = r.integer();
  s.step = r.number();
  s.change = r.number();
  s.stage = r.count();
  if (s.stage >= program_->stages.size()) throw Error(Fault::input, foreign);
  for (std::size_t k = 0; k < s.stage; ++k) {
    FinishedStage& stage = s.finished.emplace_back();
    stage.summary.status = static_cast<RunStatus>(r.count());
    stage.summary.time = r.number();
    stage.summary.steps = r.integer();
    stage.fields = r.fields();
  }
  s.state.now = r.fields();
  const std::uint64_t depth = r.count();
  for (std::uint64_t k = 0; k < depth && k < 2; ++k) {
    s.state.past_steps.push_back(r.number());
    s.state.past.push_back(r.fields());
  }
  s.state.past_rates = r.fields();
  if (world_.surface()) {
    s.began_at = r.fields();
    s.surface.scale = r.number();
    s.surface.fairing.steps = static_cast<int>(r.integer());
    s.surface.fairing.done = r.count() != 0;
    s.surface.fairing.kept = r.count();
    s.faired = r.fields();
  }
  if (!r.at_end()) throw Error(Fault::input, foreign);
  return s;
}

/// Whether these are rates at the samples and fluxes of the model's species.
bool Run::has_rates(const std::vector<Vector>& rates, const StageProgram& stage) const {
  const std::size_t species = stage.model.species_count();
  if (rates.size() != (stage.model.equations().fluxes.empty() ? species : 2 * species)) return false;
  const auto fluxes = rates.begin() + static_cast<std::ptrdiff_t>(species);
  return has_sizes({rates.begin(), fluxes}, species, space().sampled(stage.stepper->samples).sampling->count()) &&
         std::all_of(fluxes, rates.end(),
                     [&](const Vector& f) { return f.size() == 0 || f.size() == space().unknowns(); });
}

/// Whether all sizes are those of this run.
bool Run::fits(const Snapshot& s) const {
  const StageProgram& p = program_->stages[s.stage];
  const Eigen::Index unknowns = space().unknowns();
  const std::size_t species = p.model.species_count();
  bool fits = has_sizes(s.state.now, species, unknowns);
  for (const auto& fields : s.state.past) fits = fits && has_sizes(fields, species, unknowns);
  for (std::size_t k = 0; k < s.finished.size(); ++k)
    fits = fits && has_sizes(s.finished[k].fields, program_->stages[k].model.species_count(), unknowns);
  if (p.stepper->keeps_rates && !s.state.past.empty()) fits = fits && has_rates(s.state.past_rates, p);
  if (p.stepper->refreshes && !s.state.past_rates.empty()) fits = fits && has_rates(s.state.past_rates, p);
  if (!world_.surface()) return fits;
  return fits && s.surface.scale > 0 && has_sizes(s.began_at, 1, 3 * std::ssize(program_->shape->points)) &&
         has_sizes(s.faired, 1, 3 * std::ssize(world_.surface()->state().fairing.points));
}

/// All is made beside what there is, and put in its place when it is complete.
void Run::restore(const std::string& bytes) {
  Snapshot s = read_snapshot(bytes);
  if (!fits(s)) throw Error(Fault::input, foreign);
  World world = world_.unmoved();
  if (world.surface()) world.place(as_points(s.began_at[0]));
  std::vector<std::string> warnings = program_->warnings;
  std::unique_ptr<Stage> stage = begin(s.stage, world, s.finished, warnings);
  stage->state = std::move(s.state);
  if (world.surface()) {
    stage->began_at = as_points(s.began_at[0]);
    s.surface.fairing.points = as_points(s.faired[0]);
    world.restore(std::move(s.surface));
    stage->equations = StageSystem(program_->stages[s.stage], world.shared_space(), stage->material);
  }
  stage->step = s.step;
  stage->summary = {};
  stage->summary.time = stage->state.time;
  stage->summary.steps = stage->state.step;
  stage->summary.step = s.step;
  stage->summary.change = s.change;
  check_stop(world, *stage);
  world_ = std::move(world);
  stage_ = s.stage;
  finished_ = std::move(s.finished);
  now_ = std::move(stage);
  warnings_ = std::move(warnings);
  show_followers();
}

}  // namespace pelage
