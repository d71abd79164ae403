#include "catalog/names.h"

#include <algorithm>

#include "base/ascii.h"
#include "shape/texture.h"

namespace pelage {

void require_name(const Given<std::string>& name) {
  const auto is_part = [](char c) { return is_letter_or_digit(c) || c == '_'; };
  if (name.value.empty() || is_digit(name.value[0]) || !std::ranges::all_of(name.value, is_part))
    throw Error(Fault::usage, "\"" + name.value + "\" is not a name; use letters, digits and _", name.where);
}

void take_texture_name(const Given<std::string>& texture, std::vector<std::string>& attributes) {
  for (const std::string& name : color_names(texture.value)) {
    if (std::ranges::count(attributes, name) > 0)
      throw Error(
          Fault::usage,
          "the texture \"" + texture.value + "\" would hide another attribute \"" + name + "\"; give it another name",
          texture.where);
    attributes.push_back(name);
  }
}

}  // namespace pelage
