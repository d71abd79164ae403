#pragma once
// What a gallery shows, and on what.

#include <string>
#include <vector>

#include "pelage/io.h"
#include "pelage/recipe.h"

namespace pelage {

/// A model, a variant or a recipe.
struct GallerySubject {
  std::string name;                  ///< what --model or --recipe takes
  std::string title, summary, cite;  ///< the last two empty for variants and recipes
  Recipe recipe;
};

/// The models of these names, each with its variants, all of them when there is none; patterns of `size`. Faults of
/// files and of the size are thrown before any work.
std::vector<GallerySubject> model_subjects(const std::vector<std::string>& names, const Length& size);

/// The recipes of these names, or all of them.
std::vector<GallerySubject> recipe_subjects(const std::vector<std::string>& names);

struct GalleryShape {
  std::string name;
  ShapeFile file;
};

/// These shapes, with that unit if it is given; those that suit models or recipes when there is none.
std::vector<GalleryShape> gallery_shapes(const std::vector<std::string>& paths, bool of_recipes,
                                         const std::optional<double>& metres_per_unit = {});

}  // namespace pelage
