#include "look/comparison.h"

namespace pelage {

std::optional<ComparedFormulas> compared(const std::string& text) {
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string::npos || at == 0) return {};
  const std::size_t behind = at + (text.substr(at + 1).starts_with('=') ? 2 : 1);
  if (behind >= text.size() || text.find_first_of("<>=", behind) != std::string::npos) return {};
  return ComparedFormulas{text.substr(0, at), text.substr(behind), text[at]};
}

}  // namespace pelage
