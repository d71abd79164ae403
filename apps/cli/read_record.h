#pragma once
// What files say of themselves, for the commands that show it.

#include <string>
#include <vector>

#include "io/record.h"

namespace pelage {

/// Error(Fault::input) with the path where the file has no record, or none that can be read.
Record read_record(const std::string& bytes, const std::string& path);

/// A line for a shell. Whatever the file says, it is one line, without control characters.
std::string command_line(const std::vector<std::string>& words);

}  // namespace pelage
