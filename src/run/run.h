#pragma once
// The loop of the program: one stage after the other, each from its initial state to its stop.

#include <memory>
#include <string>

#include "discretise/coat_fields.h"
#include "pelage/run_summary.h"
#include "run/stage_system.h"
#include "run/world.h"
#include "time/stepper.h"

namespace pelage {

class Run {
 public:
  /// Makes the world and begins the first stage; throws Error as the parts do. `progress` is told of this and of the
  /// beginning of later stages, in advance(); where it asks to stop, Error(Fault::cancelled) leaves the run as it was.
  explicit Run(Program program, const Progress& progress = {});
  /// In a world that is there already.
  Run(std::shared_ptr<const Program> program, World world, const Progress& progress = {});
  ~Run();
  Run(Run&&) noexcept;

  bool done() const;
  /// Up to `steps` steps, fewer if the run is done before.
  const RunSummary& advance(std::int64_t steps);
  const RunSummary& summary() const;
  /// Fraction of the way to the end, as far as it is known.
  double fraction() const;

  /// What may spoil the stages that were begun: a given step beyond what the scheme stands, more anisotropy than the
  /// mesh carries. Never removed while the run goes on.
  const std::vector<std::string>& warnings() const { return warnings_; }

  const Program& program() const { return *program_; }
  const World& world() const { return world_; }
  const Space& space() const { return world_.space(); }
  /// Number of the stage in progress, or of the last one; and what it is.
  std::size_t stage() const { return stage_; }
  const StageProgram& stage_program() const { return program_->stages[stage_]; }
  const System& system() const;
  const std::vector<Vector>& coefficients() const;
  /// Those that the stage began with.
  std::vector<Vector> initial() const;
  struct FinishedStage {
    std::vector<Vector> fields;  ///< coefficients per species
    RunSummary summary;
  };
  /// The stages before that.
  const std::vector<FinishedStage>& finished() const { return finished_; }

  /// Range of the coefficients of species i over the largest magnitude that they have now or had when the stage began.
  double contrast(std::size_t i) const;
  /// Whether no species shows a pattern, see uniform_contrast; and what is likely to have kept it away, in words.
  bool uniform() const;
  std::string why_uniform() const;

  /// Area integrals of the species [values times world units^2].
  std::vector<double> amounts() const;
  /// The fields of all stages, to be dressed; of earlier ones "STAGE.SPECIES".
  CoatFields fields() const;
  /// Per species of these, whether it shows no pattern; those of earlier stages count as patterns.
  std::vector<char> uniform_species() const;

  /// Replaces the state of the stage by these coefficients, one field per species: steps begin anew from there, at the
  /// time that it is.
  void set_coefficients(std::vector<Vector> coefficients);
  /// The same for one species, given by its values at the nodes.
  void set_values(std::size_t species, const Vector& values);
  /// Lets a run that has come to its end go on: for as long again as its last stage was meant to take, also at rest.
  void go_on();
  /// Goes on from where another run of the same stages stands, on as many unknowns and with species of the same names:
  /// what may differ are parameters. False, and nothing happens, where there are others.
  bool take_over(const Run& other);

  /// Everything that changes, as bytes: a run of the same program that restores it continues with the same bits, on any
  /// machine that rounds the same.
  /// `note`: what a program wants to find in it again.
  std::string checkpoint(std::string_view note = {}) const;
  /// Error(Fault::input) when the bytes are not a checkpoint of this program; the run is then as before.
  void restore(const std::string& bytes);

 private:
  struct Stage;
  struct Stop;
  struct Snapshot;
  std::unique_ptr<Stage> begin(std::size_t number, const World& world, const std::vector<FinishedStage>& finished,
                               std::vector<std::string>& warnings) const;
  VertexAttributes finished_fields(const Space& space, const std::vector<FinishedStage>& finished) const;
  void next_stage();
  Snapshot read_snapshot(const std::string& bytes) const;
  bool has_rates(const std::vector<Vector>& rates, const StageProgram& stage) const;
  bool fits(const Snapshot& snapshot) const;
  double stage_fraction() const;
  double next_step() const;
  double step_tolerance() const;
  void follow_surface(double time);
  void keep_amounts(const SparseMatrix& mass_before);
  void show_followers();
  void accept(const StepReport& report, double dt);
  bool takes_too_long() const;
  void fail(const std::string& reason, const std::optional<Runaway>& runaway);
  std::string remedy(const Runaway& at) const;
  static void check_stop(const World& world, Stage& stage);

  std::shared_ptr<const Program> program_;
  World world_;
  Progress progress_;
  std::size_t stage_ = 0;
  std::vector<FinishedStage> finished_;
  std::unique_ptr<Stage> now_;
  std::vector<std::string> warnings_;
};

/// Below this contrast a field counts as uniform. The forcing of a model (a slightly uneven substrate, say) shows
/// contrasts of up to a percent without a pattern; the faintest pattern of a shipped model has several.
inline constexpr double uniform_contrast = 0.02;

/// 2 pi sqrt(<u', M u'> / <u', K u'>) with u' the deviation from the mean: the wavelength of a single wave, and between
/// the wavelength of the spots and that of their harmonics for sharp spots. World units.
double measured_wavelength(const SparseMatrix& mass, const SparseMatrix& stiffness, const Vector& u);

/// Error(Fault::input) where the bytes are no checkpoint, of another version, damaged or cut short.
std::string note_of_checkpoint(const std::string& bytes);

}  // namespace pelage
