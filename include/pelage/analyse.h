#pragma once
// What linear theory knows about a model before anything grows.
//
//   const pelage::Analysis a = pelage::analyse("turing", {{"s", 0.06}});
//   std::cout << a.verdict << ", " << *a.stability.wavelength << " long\n";
//
// All errors are pelage::Error, see error.h.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pelage/error.h"
#include "pelage/recipe.h"
#include "pelage/stability.h"

namespace pelage {

/// The largest stable step of a time stepper [model time]; infinite where none is known to be too large.
struct StepLimit {
  std::string stepper;
  double step = 0;
};

struct Analysis {
  std::string title;                         ///< of the model
  std::map<std::string, double> parameters;  ///< in use
  std::vector<std::string> species;
  Stability stability;            ///< about the steady state nearest to the initial values: fastest wavelength, its
                                  ///< growth, whether it oscillates, the band of waves that grow
  std::vector<Stability> states;  ///< the same about every steady state
  Regime regime = Regime::no_state;
  std::string verdict;                         ///< the regime in one line
  std::vector<Condition> conditions;           ///< for a Turing pattern
  std::vector<DiffusionThreshold> thresholds;  ///< where the waves begin or end to grow
  std::vector<std::string> thresholds_in_words;
  std::optional<double> spacing;         ///< of the finished pattern [model length], which Stage::size stretches
  bool spacing_stated = false;           ///< by the model's file, as measured; else it is the fastest wavelength
  std::optional<double> resolved;        ///< length that a mesh has to resolve where the spacing is unknown: on which
                                         ///< diffusion is as fast as the reaction [model length]
  double resolution = 0;                 ///< vertices per spacing of the coarsest mesh that carries the pattern
  std::vector<StepLimit> largest_steps;  ///< on such a mesh; none without a spacing
};

/// The names of the built-in models and their variants, "turing" and "turing:production".
std::vector<std::string> model_names();

/// Analyses a model with some of its parameters changed: a built-in one, "name:variant", the path of a .toml file, or
/// one of `texts`. Error(Fault::usage) for unknown names, parameters outside of their ranges and faults in a model;
/// Error(Fault::input) for a file that cannot be read.
Analysis analyse(const std::string& model, const std::map<std::string, double>& parameters = {},
                 const ModelTexts& texts = {});

/// The same for one model at many parameters: the model is read once. Cheap to copy; analyses may run in several
/// threads at once.
class ModelAnalyser {
 public:
  explicit ModelAnalyser(const std::string& model, const ModelTexts& texts = {});
  Analysis at(const std::map<std::string, double>& parameters = {}) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace pelage
