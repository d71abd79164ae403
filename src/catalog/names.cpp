#include "catalog/names.h"

#include <algorithm>

#include "base/ascii.h"

namespace pelage {

void require_name(const Given<std::string>& name) {
  const auto is_part = [](char c) { return is_letter_or_digit(c) || c == '_'; };
  if (name.value.empty() || is_digit(name.value[0]) || !std::ranges::all_of(name.value, is_part))
    throw Error(Fault::usage, "\"" + name.value + "\" is not a name; use letters, digits and _", name.where);
}

}  // namespace pelage
