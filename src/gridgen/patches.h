#pragma once
// Files of patches: parametric surfaces and bicubic Bezier patches that are sewn together. docs/patches.md has the
// format.

#include <array>
#include <string>
#include <string_view>

#include "pelage/atlas.h"

namespace pelage {

/// Makes the patches of a TOML text and sews them; `file` is the name for messages, its folder that of files which it
/// names. Where the file has a cell there are `refine` along either axis. Error(Fault::usage), located, for what is no
/// file of patches and for formulas; Error(Fault::input) as sew().
Atlas parse_patches(std::string_view text, const std::string& file, std::int32_t refine = 1);

/// The bicubic Bezier patches of a .bpt file: their number, then "3 3" and 16 control points each, along u first.
/// Error(Fault::input), with the line, for anything else.
std::vector<std::array<Point, 16>> parse_bpt(std::string_view text, const std::string& file);

/// The point at (u, v), each from 0 to 1.
Point bezier_point(const std::array<Point, 16>& control, double u, double v);

}  // namespace pelage
