#pragma once
// "x + y < 1": two formulas and what stands between them.

#include <optional>
#include <string>

namespace pelage {

struct ComparedFormulas {
  std::string left, right;
  char sign = 0;  ///< '<', '>' or '=', the first character of what stands between them
};

/// Nothing where there is no such sign, more than one, or nothing on one side of it.
std::optional<ComparedFormulas> compared(const std::string& text);

}  // namespace pelage
