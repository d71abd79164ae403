#pragma once
// The loop of the program: one stage after the other, each from its initial state to its stop.

#include <memory>
#include <string>

#include "base/progress.h"
#include "look/dress.h"
#include "run/moving_surface.h"
#include "run/operators.h"
#include "run/program.h"
#include "time/stepper.h"

namespace pelage {

/// How a run stands.
enum class RunStatus {
  running,
  time_reached,
  steps_reached,
  stationary,
  failed  ///< the fields blew up or a solve did not converge; see RunSummary::message
};

/// What has happened so far in a stage.
struct RunSummary {
  RunStatus status = RunStatus::running;
  std::string message;  ///< of a failure: what, where, and what to do
  double time = 0;      ///< model time
  std::int64_t steps = 0;
  double step = 0;                  ///< size of the next step
  double change = 0;                ///< of the pattern per unit of time, relative to its amplitude
  std::int64_t iterations = 0;      ///< of the linear solver since the start or resumption
  std::int64_t rejected = 0;        ///< steps repeated with a smaller size
  double minimum = 0, maximum = 0;  ///< of the coefficients of all species
};

class Run {
 public:
  /// Builds the operators and the initial state; throws Error as the parts do.
  explicit Run(Program program, const Progress& progress = {});
  /// Several stages on one shape, which the first one brings.
  explicit Run(std::vector<Program> stages, const Progress& progress = {});
  ~Run();
  Run(Run&&) noexcept;

  bool done() const;
  /// Up to `steps` steps, fewer if the run is done before.
  const RunSummary& advance(std::int64_t steps);
  const RunSummary& summary() const { return summary_; }
  /// Fraction of the way to the end, as far as it is known.
  double fraction() const;

  /// What may spoil the stages that were begun: a given step beyond what the scheme stands, more anisotropy than the
  /// mesh carries. Never removed while the run goes on.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The stage in progress, or the last one.
  const Program& program() const { return stages_[stage_]; }
  std::size_t stage() const { return stage_; }
  struct FinishedStage {
    std::vector<Vector> fields;  ///< coefficients per species
    RunSummary summary;
  };
  /// The stages before that.
  const std::vector<FinishedStage>& finished() const { return finished_; }
  const std::vector<Program>& stages() const { return stages_; }
  const Operators& operators() const { return *operators_; }
  const std::vector<Vector>& coefficients() const { return state_.now; }
  /// Null when the surface stays where it is.
  const MovingSurface* surface() const { return surface_.get(); }
  /// Area integrals of the species [values times world units^2].
  std::vector<double> amounts() const;
  /// A copy of the fields of all stages, to be dressed; of earlier ones "STAGE.SPECIES".
  CoatFields fields() const;

  /// Everything that changes, as bytes (little-endian doubles): a run of the same program that restores it continues
  /// with the same bits.
  std::string checkpoint() const;
  /// Error(Fault::input) when the bytes are not a checkpoint of such a run.
  void restore(const std::string& bytes);

 private:
  struct Snapshot;
  bool stage_done() const { return summary_.status != RunStatus::running; }
  void begin_stage(const Progress& progress);
  void warn_about_stage(double stable_step);
  void next_stage();
  void enter_stage(std::size_t number, std::vector<Point> points);
  Snapshot read_snapshot(const std::string& bytes) const;
  bool fits(const Snapshot& snapshot) const;
  double next_step() const;
  void follow_surface(double time);
  void keep_amounts(const SparseMatrix& mass_before);
  void accept(const StepReport& report, double dt);
  bool takes_too_long() const;
  void fail(const std::string& reason);
  void check_stop();

  std::vector<Program> stages_;
  std::size_t stage_ = 0;
  std::vector<FinishedStage> finished_;
  std::unique_ptr<Operators> operators_;
  std::unique_ptr<MovingSurface> surface_;
  std::unique_ptr<Stepper> stepper_;
  State state_;
  std::vector<std::string> warnings_;
  double step_ = 0;
  RunSummary summary_;
};

/// 2 pi sqrt(<u', M u'> / <u', K u'>) with u' the deviation from the mean: the wavelength of a single wave, and between
/// the wavelength of the spots and that of their harmonics for sharp spots. World units.
double measured_wavelength(const SparseMatrix& mass, const SparseMatrix& stiffness, const Vector& u);

}  // namespace pelage
