#include "catalog/analysis.h"

#include "catalog/models.h"
#include "react/stability.h"
#include "react/turing_conditions.h"
#include "react/wavelength.h"
#include "run/resolution.h"
#include "time/step_limit.h"
#include "time/stepper.h"

namespace pelage {

namespace {

std::vector<StepLimit> largest_steps(const Model& model, const Stability& stability, double spacing,
                                     double resolution) {
  const double k2 = largest_k2_of_coarsest_mesh(spacing, resolution);
  std::vector<StepLimit> limits;
  for (const StepperKind* stepper : stepper_kinds())
    if (!stepper->any_step && !stepper->lattice && (stepper->couples || model.coupled().empty()))
      limits.push_back({std::string(stepper->name), largest_stable_step(model, stability, *stepper, k2)});
  return limits;
}

}  // namespace

Analysis analysis_of(const Model& model) {
  Analysis a;
  a.title = model.source().title;
  for (const ParameterSource& p : model.parameters()) a.parameters[p.name] = p.value;
  for (std::size_t i = 0; i < model.species_count(); ++i) a.species.push_back(model.species_name(i));
  a.stability = analyse(model);
  for (const std::vector<double>& state : a.stability.steady_states) a.states.push_back(analyse_at(model, state));
  a.regime = regime_of(a.stability);
  a.verdict = describe(a.regime);
  a.conditions = turing_conditions(a.stability, a.species);
  a.thresholds = diffusion_thresholds(a.stability);
  a.thresholds_in_words = describe(a.thresholds, a.stability, a.species);
  a.spacing = known_wavelength(model);
  if (!a.spacing) a.resolved = diffusion_length(model);
  a.spacing_stated = states_wavelength(model.source());
  a.resolution = model.source().suggestions.resolution_or_default();
  if (a.spacing && !a.states.empty()) a.largest_steps = largest_steps(model, a.stability, *a.spacing, a.resolution);
  return a;
}

struct ModelAnalyser::Parts {
  ModelSource source;
};

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const ModelEntry& entry : model_list()) names.push_back(entry.name);
  return names;
}

ModelAnalyser::ModelAnalyser(const std::string& model, const ModelTexts& texts)
    : parts_(std::make_shared<const Parts>(Parts{find_model(model, texts)})) {}

Analysis ModelAnalyser::at(const std::map<std::string, double>& parameters) const {
  Overrides overrides;
  for (const auto& [name, value] : parameters) overrides[name] = value;
  return analysis_of(compile(parts_->source, overrides));
}

Analysis analyse(const std::string& model, const std::map<std::string, double>& parameters, const ModelTexts& texts) {
  return ModelAnalyser(model, texts).at(parameters);
}

}  // namespace pelage
