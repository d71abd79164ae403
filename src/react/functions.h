#pragma once
// The table of functions of the formula language that are built from operations alone.

#include <span>
#include <string_view>

#include "react/expression.h"

namespace pelage {

struct Function {
  std::string_view name;
  std::string_view usage;  ///< as shown in messages
  std::size_t arguments;
  Term (*build)(std::span<const Term>);
  std::string_view meaning;  ///< one line
};

/// All of them, in the order of the documentation.
std::span<const Function> pure_functions();

}  // namespace pelage
