#pragma once
// Columns of text.

#include <string>
#include <vector>

namespace pelage {

/// Rows as lines, every column but the last padded to its widest cell, two blanks between columns.
std::string table(const std::vector<std::vector<std::string>>& rows, std::size_t indent = 0);

}  // namespace pelage
