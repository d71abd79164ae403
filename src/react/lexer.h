#pragma once
// Cuts the text of a formula into tokens, each with its place in the file.

#include <string>
#include <string_view>
#include <vector>

#include "pelage/error.h"

namespace pelage {

/// The text of a formula and where it starts (columns count characters, not bytes).
struct Formula {
  std::string text;
  Location where;
  int component = 0;  ///< for which a name of a vector stands: 1, 2 or 3; 0: for none
};

struct Token {
  enum class Kind { number, name, sign, end };
  Kind kind = Kind::end;
  std::string_view text;  ///< a piece of the formula's text, which must outlive it; empty at the end
  double number = 0;      ///< value of a number
  Location where;
};

/// The tokens of a formula, the last of kind `end`. Error(usage) for characters that mean nothing, numbers out
/// of range, and formulas of more than 10,000 characters.
std::vector<Token> tokenize(const Formula& formula);

}  // namespace pelage
