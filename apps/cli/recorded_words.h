#pragma once
// The words of a command as its files remember them.

#include <string>
#include <vector>

#include "command.h"

namespace pelage {

/// Whether a command writes files that are named by options and nothing else.
bool can_be_repeated(const std::string& command);

/// What was given, in the order in which the command declares its options. Left out is what cannot change a byte of the
/// outputs (threads, checkpoints, what is printed); of the names of outputs "*" and the extension are left.
std::vector<std::string> recorded_words(const CLI::App& command);

/// Such words with names for the outputs. Each has a folder of its own, since two may end alike: FOLDER/1/NAME.glb,
/// FOLDER/2/NAME.png, ..., where NAME is that of `file`. Where no output is named, that is one like `file`. Makes these
/// folders.
std::vector<std::string> words_to_repeat(std::vector<std::string> words, const std::string& folder,
                                         const std::string& file);

}  // namespace pelage
