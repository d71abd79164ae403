#pragma once
// The unit of a shape, where the file does not say it or says another one.

#include <optional>
#include <string>

#include "command.h"
#include "pelage/io.h"

namespace pelage {

/// --input-unit NAME, in metres.
CLI::Option* add_input_unit_option(CLI::App& app, std::optional<double>& metres);

/// The shape with that unit, if one was given, instead of what its format says.
ShapeFile read_shape(const std::string& path, const std::optional<double>& metres_per_unit);

/// The same for commands that need faces: Error(Fault::input) for a cloud of points.
ShapeFile read_surface(const std::string& path, const std::optional<double>& metres_per_unit = {});

}  // namespace pelage
