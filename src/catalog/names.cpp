#include "catalog/names.h"

#include <algorithm>
#include <cctype>

namespace pelage {

void require_name(const Given<std::string>& name) {
  const auto is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  if (name.value.empty() || std::isdigit(static_cast<unsigned char>(name.value[0])) ||
      !std::ranges::all_of(name.value, is_part))
    throw Error(Fault::usage, "\"" + name.value + "\" is not a name; use letters, digits and _", name.where);
}

}  // namespace pelage
