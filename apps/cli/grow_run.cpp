#include "grow_run.h"

#include <algorithm>
#include <optional>

#include "base/number.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "run/nested.h"
#include "text.h"

namespace pelage {

namespace {

/// The program looks at Ctrl-C and the bar about so often, as long as single steps are shorter [s].
constexpr double slice = 0.1;

/// How long a growth will take, by the speed of its first steps.
class GrowthClock {
 public:
  /// Of all stages [s]; once, when it is known.
  std::optional<double> estimate(const Run& run) {
    constexpr double watched = 0.15;
    const auto iterations = static_cast<double>(run.summary().iterations);
    const double now = watch_.seconds();
    if (told_ || run.stage() > 0 || run.done()) return {};
    if (seconds_ < 0) {  // the first step sets up the solver
      seconds_ = now;
      iterations_ = iterations;
    }
    if (now - seconds_ < watched || !(iterations > iterations_)) return {};
    told_ = true;
    double rest = -iterations;
    for (const StageProgram& p : run.program().stages) {
      if (!p.iterations) return {};
      rest += *p.iterations;
    }
    return now + std::max(0.0, rest) * (now - seconds_) / (iterations - iterations_);
  }

 private:
  Stopwatch watch_;
  double seconds_ = -1, iterations_ = 0;  ///< after the first step
  bool told_ = false;
};

void begin_nested(Run& run, const Progress& progress, GrowReport& report) {
  const int grids =
      interruptible("before the growth began; nothing was written", [&] { return grow_nested(run, progress); });
  if (grids == 0)
    report.warning(
        "--nested changes nothing: it takes an even grid with an even number of nodes along periodic axes and an odd "
        "one along others, and six of every second node for the wavelength");
}

[[noreturn]] void interrupted(const Run& run, const std::string& checkpoint) {
  const std::string stage = run.program().stages.size() > 1 ? "stage " + run.stage_program().name + ", " : "";
  const std::string place = "interrupted at " + stage + std::to_string(run.summary().steps) + " steps, time " +
                            number(run.summary().time) + "; no mesh or picture was written";
  if (checkpoint.empty()) throw Error(Fault::cancelled, place + "; with --checkpoint FILE it could go on from here");
  throw Error(Fault::cancelled, place + "; go on with: pelage resume " + checkpoint);
}

/// So many steps that they take about one slice, growing slowly since the steps of a settling pattern differ.
std::int64_t next_steps(std::int64_t steps, double seconds) {
  const double wanted = static_cast<double>(steps) * slice / std::max(seconds, 1e-6);
  return std::clamp(static_cast<std::int64_t>(wanted), std::int64_t{1}, 2 * steps);
}

/// Where Ctrl-C comes while a stage begins, the run stays at the end of the one before.
void advance(Run& run, std::int64_t steps) {
  try {
    run.advance(steps);
  } catch (const Error& error) {
    if (error.fault() != Fault::cancelled) throw;
  }
}

std::string beside_output(const GrowOptions& options) {
  const std::string output = options.outputs.empty() ? options.picture : options.outputs.front();
  return output.empty() ? "" : output + ".checkpoint";
}

/// The state before the step that failed is kept, to be looked at.
[[noreturn]] void failed(const Run& run, const GrowOptions& options, CheckpointFile& saved) {
  const RunSummary& summary = run.summary();
  if (summary.steps == 0) throw Error(Fault::numerics, summary.message);
  if (saved.path().empty()) saved.keep_at(beside_output(options));
  saved.save(run);
  const std::string kept = saved.path().empty() ? ""
                                                : "; the state before is kept: --resume " + saved.path() + " --until " +
                                                      exact_number(summary.time) + " shows it";
  throw Error(Fault::numerics, summary.message + kept);
}

/// Where a growth takes long and nobody thought of that.
void keep_beside(const GrowOptions& options, CheckpointFile& saved, GrowReport& report) {
  saved.keep_at(beside_output(options));
  if (saved.path().empty()) return;
  report.saving(saved.path(), options.every_minutes);
}

}  // namespace

void restore(Run& run, const std::string& path, GrowReport& report) {
  if (path.empty()) return;
  const std::string bytes = read_checkpoint(path, [&](const std::string& text) { report.warning(text); });
  try {
    run.restore(bytes);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
}

void set_out(Run& run, const GrowOptions& options, const Progress& progress, GrowReport& report) {
  if (options.nested && options.resume.empty()) begin_nested(run, progress, report);
  restore(run, options.resume, report);
  report.warnings(run);
  report.pattern(run);
}

void grow_to_the_end(Run& run, const GrowOptions& options, const Observer& each_step, CheckpointFile& saved,
                     const Progress& progress, GrowReport& report) {
  std::int64_t steps = 1;
  GrowthClock clock;
  while (!run.done() && progress("growing", run.fraction())) {
    const Stopwatch watch;
    advance(run, steps);
    if (each_step)
      each_step(run);
    else
      steps = next_steps(steps, watch.seconds());
    report.warnings(run);
    if (const auto seconds = clock.estimate(run)) {
      report.estimate(run, *seconds);
      if (saved.path().empty() && *seconds > 60 * options.every_minutes) keep_beside(options, saved, report);
    }
    saved.look_at(run);
  }
  if (run.summary().status == RunStatus::failed) failed(run, options, saved);
  saved.save(run);
  if (interrupt_signal()) interrupted(run, saved.path());
}

}  // namespace pelage
