#pragma once
// Random words on the command line.

#include <string_view>

namespace pelage {

/// The words of a command line, one a line: they are parsed, and of "grow" the recipe that they stand for is made and
/// planned. Nothing is run, read but texts, or written. Throws Error for what is wrong with them.
void read_arguments(std::string_view lines);

}  // namespace pelage
