#pragma once
// What a text may ask of its parser: TOML lets a file of a megabyte describe tables ten thousand deep.

#include <cstddef>
#include <string>
#include <string_view>

namespace pelage {

/// Models, recipes, scenes, regions and patches are a few kB; the largest by far are outlines and control points.
inline constexpr std::size_t largest_text = 1 << 20;  // bytes
/// Tables and arrays in each other, parts of dotted keys included; ours need six.
inline constexpr std::size_t deepest_text = 64;
/// Keys, headers of tables and parts of dotted keys.
inline constexpr std::size_t most_keys = 20000;

/// Error, located, where a text goes beyond these. It need not be well-formed; it is passed over once, without
/// recursion.
void require_limits(std::string_view text, const std::string& file);

}  // namespace pelage
