#pragma once
// The options of pelage grow.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "line_outputs.h"
#include "pelage/recipe_changes.h"
#include "print_options.h"
#include "view_options.h"

namespace pelage {

/// What was given; what was not is empty and left to the recipe.
struct GrowOptions : RecipeChanges {
  GrowOptions() { prefix = "--"; }

  std::string shape;
  std::optional<std::string> recipe;
  std::optional<double> input_unit;  ///< metres
  double every_minutes = 5;          ///< between checkpoints
  std::optional<int> threads;
  std::optional<std::int64_t> triangles;
  bool profile = false, nested = false, compress = false;

  std::vector<std::string> outputs;
  std::string picture, panels, plot, height_map, patch_images, checkpoint, resume;
  std::optional<int> bake;        ///< texels along a side of images on meshes
  std::string baked_maps;         ///< how the names of such images begin
  std::string onto;               ///< another mesh of the same shape that these are for, or empty
  bool mips = false;              ///< whether they have their smaller copies with them
  std::vector<std::string> cuts;  ///< "x < 0"
  std::optional<std::string> isosurface;
  LineOptions lines;
  std::array<int, 2> preview{1, 1};  ///< tiles across and down
  int picture_size = 1024;
  std::optional<int> frames;  ///< of the growth
  int from_frame = 1;
  bool loop = false;
  PrintOptions print;
  ViewOptions view;
  bool json = false, quiet = false;
};

void add_options(CLI::App& app, GrowOptions& options);

/// Whether images on the mesh are asked for.
inline bool wants_images(const GrowOptions& options) { return options.bake || !options.baked_maps.empty(); }

/// The recipe that was named, or an empty one, with the options' values on top. Error(Fault::usage) for what cannot be
/// understood, and when there is no shape.
Recipe make_recipe(const GrowOptions& options);

/// Files that are to be read are there: Error(Fault::input) if not.
void check_inputs(const GrowOptions& options, const Recipe& recipe);

/// Error(Fault::usage) when nothing would be written.
void require_outputs(const GrowOptions& options);

/// Refuses outputs that could not be written after the work: Error(Fault::usage) for unknown extensions and for an
/// output that is the input; Error(Fault::output) for folders.
void check_outputs(const GrowOptions& options, const std::string& shape);

}  // namespace pelage
