#pragma once
// The words of the formula language as people read them: `pelage formulas` prints them, docs/models.md has the same
// table, and the names of the parser come from here.

#include <string>
#include <string_view>
#include <vector>

namespace pelage {

struct Word {
  std::string_view group;
  std::string usage;    ///< "sqrt(a)"; a name by itself
  std::string meaning;  ///< one line, with the range where there is one

  /// "sqrt".
  std::string_view name() const { return std::string_view(usage).substr(0, usage.find_first_of("( ")); }
};

/// All of them, group after group: names and functions, those of pure_functions() with their meaning from there.
const std::vector<Word>& words();

/// What stands between numbers and names: usage and meaning.
const std::vector<Word>& operators();

}  // namespace pelage
