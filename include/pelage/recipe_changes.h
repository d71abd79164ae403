#pragma once
// What a command or a program changes in a recipe, by the names of the options of `pelage grow`.
//
//   pelage::RecipeChanges changes;
//   changes.size = "4mm";
//   changes.settings = {"s=0.06"};
//   pelage::Recipe recipe = pelage::with_changes(pelage::load_recipe("leopard"), changes);

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pelage/recipe.h"

namespace pelage {

/// What is empty or false is left to the recipe. But for the fairing, the motion and the look, all of it goes for every
/// stage; see Stage, Motion and Look for what it means.
struct RecipeChanges {
  std::string prefix = {};  ///< of the names below in messages: "--" of a command line
  std::optional<std::string> model, quality, method, stepper, solver;
  std::optional<std::string> size;    ///< of the first stage, as parse_length() takes it; those of the others keep
                                      ///< their proportion to it
  std::optional<std::string> unit;    ///< instead of it, of recipes with one stage
  std::vector<std::string> settings;  ///< "PARAM=VALUE" or "STAGE.PARAM=VALUE", also "STAGE.size=LENGTH"
  std::vector<std::string> maps;      ///< "PARAM=FORMULA", likewise; "attribute:NAME" is attribute(NAME)
  std::vector<std::string> textures;  ///< "NAME=FILE"
  std::optional<std::int64_t> cells;
  bool solid = false;  ///< the method for volumes
  std::optional<double> step, until, stationary, crease;
  std::optional<std::int64_t> steps, refresh;
  std::optional<std::uint64_t> seed;
  bool interpolate = false;

  std::string fair;  ///< method of fairing
  std::optional<double> growth;
  std::optional<std::string> motion;  ///< Motion::mode
  std::optional<std::int64_t> every;

  std::optional<std::string> species, ramp;
  std::vector<std::string> channels;  ///< "CHANNEL=FORMULA", see channel.h
  std::optional<int> detail;
  bool invert = false, keep_shape = false, flat = false, displace = false, no_fields = false;
};

/// Error(Fault::usage) for texts that are none of these forms, unknown stages and channels, and changes that exclude
/// each other.
Recipe with_changes(Recipe recipe, const RecipeChanges& changes);

}  // namespace pelage
