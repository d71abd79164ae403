#pragma once
// Coats to be printed: with holes, with walls, and what there is to say of their surfaces.

#include <optional>
#include <string>
#include <vector>

#include "catalog/size.h"
#include "command.h"
#include "look/tessellation.h"

namespace pelage {

struct PrintOptions {
  std::optional<std::string> holes;      ///< condition
  std::optional<std::string> thickness;  ///< length
  bool any() const { return holes || thickness; }
};

void add_print_options(CLI::App& app, PrintOptions& options, const std::string& group);

/// Refuses what does not go together or cannot be understood, before any work: Error(Fault::usage). `species`: of the
/// finished coat; `images`: whether such on the shape's uv are asked for.
void check_print(const PrintOptions& options, const Look& look, const ShapeFile& file, bool images,
                 const std::vector<std::string>& species);

/// A coat and what there is to say of how it was made.
struct PrintedCoat {
  TriangleMesh coat;
  std::vector<std::string> warnings;
};

/// Tells the paint of the holes.
void add_holes(Paint& paint, const PrintOptions& options);

/// The tessellation dressed, with holes and walls if they are asked for. `scale`: of the shape. Errors of with_holes,
/// dress and world_length.
PrintedCoat printed_coat(Tessellation tessellation, const Paint& paint, const std::vector<char>& uniform,
                         const PrintOptions& options, const ShapeScale& scale);

/// How often a surface goes through itself, and where first; empty where it does not.
std::string line_about_meetings(const TriangleMesh& coat);

/// Its size, pieces and handles, in words.
std::string about_solid(const TriangleMesh& solid);

}  // namespace pelage
