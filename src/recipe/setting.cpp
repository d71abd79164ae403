#include "recipe/setting.h"

#include <charconv>
#include <cmath>

namespace pelage {

Stage::Setting parse_setting(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  Stage::Setting setting{text.substr(0, equals), 0, {}};
  const char* begin = text.data() + (equals == std::string::npos ? text.size() : equals + 1);
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(begin, end, setting.value);
  if (setting.name.empty() || begin == end || error != std::errc{} || last != end || !std::isfinite(setting.value))
    throw Error(Fault::usage,
                option + " " + text + ": expected PARAM=VALUE with a number, for example " + option + " s=0.06");
  return setting;
}

}  // namespace pelage
