#pragma once
// Joins names to components: every unknown name, unit or parameter is an error here, before any work.

#include "pelage/recipe.h"
#include "run/program.h"

namespace pelage {

/// Default of Stage::size, as a fraction of the diagonal.
inline constexpr double default_size = 0.04;

/// The stages; the first one has the shape. Error(Fault::usage), located in the recipe, for anything unknown;
/// Error(Fault::input) for a shape without extent and for images that cannot be read. The images of a shape without
/// triangles, which stands in for one that is not read yet, are looked at but not read.
std::vector<Program> resolve(const Recipe& recipe, TriangleMesh shape);

/// The same without a shape, which may take long to read: finds all but what depends on the shape's attributes.
void check_names(const Recipe& recipe);

/// Loop elements are made for moderate valences. Gives a recipe that does not ask for them by a line of its own linear
/// elements where the mesh has more; says so for people, or returns nothing where the method may stay.
std::string fit_method(Recipe& recipe, const TriangleMesh& mesh);

/// The built-in recipe of that name, or the one in the file when the name ends in .toml.
Recipe load_recipe(const std::string& name_or_path);
std::vector<std::string> recipe_names();

}  // namespace pelage
