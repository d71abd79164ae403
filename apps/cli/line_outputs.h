#pragma once
// --lines: isolines of a coat as files.

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "look/coat_lines.h"

namespace pelage {

/// What was given.
struct LineOptions {
  std::vector<std::string> files;
  std::vector<std::string> isolines;  ///< "b = 4"
  std::string view = "front";         ///< of drawings, or uv
};

/// --lines, --isoline and --lines-view.
void add_line_options(CLI::App& app, LineOptions& options, const std::string& group);

/// Before any work: Error(Fault::usage) for unknown extensions and species, isolines that are none, and options
/// without --lines; Error(Fault::output) for folders. `species`: of the finished run.
void check_lines(const LineOptions& options, const std::vector<std::string>& species);

/// The lines of a coat, ready for files.
struct LineFiles {
  std::vector<std::string> about;  ///< per file, what there is to say of it
  std::vector<std::string> warnings;
};

/// Writes all files. Error(Fault::usage) for a shape without triangles, for one without uv, and for isolines that read
/// what the shape has not.
LineFiles write_lines(const LineOptions& options, const CoatFields& fields, const Look& look, UpAxis up);

}  // namespace pelage
