#pragma once
// From the arguments to the command, with the house's errors for what is wrong.

#include <vector>

#include "command.h"

namespace pelage {

/// The command that the arguments ask for, its options filled in. Error(Fault::usage) for unknown commands and options,
/// missing and unusable values; CLI::Success when help or the version is asked for.
const Command& parse_arguments(CLI::App& app, const std::vector<Command>& commands, std::vector<std::string> words);

/// Of --threads.
inline constexpr int most_threads = 1024;

/// Checks of an option's value, with messages for people.
CLI::Validator whole_number(std::int64_t least, std::int64_t most);
CLI::Validator positive_number();
CLI::Validator number_at_least_zero();

}  // namespace pelage
