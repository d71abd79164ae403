#pragma once
// Joins the names of a recipe to components. Every fault that needs no shape is found here, before any work.

#include <optional>
#include <vector>

#include "catalog/components.h"
#include "catalog/quality.h"
#include "look/palette.h"
#include "pelage/fair.h"
#include "pelage/recipe.h"
#include "react/model.h"
#include "react/place_formula.h"
#include "run/borders.h"

namespace pelage {

struct PlannedStage {
  Stage asked;            ///< what the recipe says
  Model model;            ///< with what the stage changes in it
  double wavelength = 0;  ///< of the model with its numbers, before formulas take the place of any [model length]
  bool wavelength_known = true;  ///< false: it is diffusion_length()
  const StepperKind* stepper = nullptr;
  const SolverKind* solver = nullptr;
  std::optional<PlaceFormula> size_map;  ///< where a mesh alone tells it
  std::optional<PlaceFormula> from, to;  ///< of the directions
  std::vector<BorderCondition> borders;
  double until = 0;  ///< model time
};

/// Immutable; nothing in it depends on a shape.
struct Plan {
  const Method* method = nullptr;
  std::optional<Given<std::int64_t>> cells;  ///< how many
  bool method_asked = false;  ///< by the recipe: then it is not exchanged for one that suits the shape better
  const Quality* quality = nullptr;
  bool interpolate = false;
  std::optional<Given<double>> crease;  ///< angle [degrees]
  std::vector<TextureFile> textures;
  std::vector<Brush> brushes;
  std::vector<PlannedStage> stages;
  Motion motion;
  std::optional<FairOptions> fair;
  double until = 0;  ///< of all stages together
  Paint paint;
};

/// The recipe's look; where it says neither ramp nor layers, with those by which the model of the last stage shows
/// itself (its layers unless a species was chosen). Errors of load_model.
Look shown_look(const Recipe& recipe);

/// Error(Fault::usage), located in the recipe, for anything unknown, contradictory or misspelt.
Plan plan(const Recipe& recipe, const Components& components = {});

}  // namespace pelage
