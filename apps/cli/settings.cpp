#include "settings.h"

#include <charconv>
#include <cmath>

#include "catalog/models.h"

namespace pelage {

CLI::Option* add_settings_option(CLI::App& app, std::vector<std::string>& settings) {
  return app.add_option("--set", settings, "Parameter of the model; give it once per parameter")
      ->type_name("PARAM=VALUE")
      ->delimiter(',')
      ->allow_extra_args(false);
}

Stage::Setting parse_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  Stage::Setting setting{text.substr(0, equals), 0, {}};
  const char* begin = text.data() + (equals == std::string::npos ? text.size() : equals + 1);
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(begin, end, setting.value);
  if (setting.name.empty() || begin == end || error != std::errc{} || last != end || !std::isfinite(setting.value))
    throw Error(Fault::usage, "--set " + text + ": expected PARAM=VALUE with a number, for example --set s=0.06");
  return setting;
}

Model load_model_with(const std::string& name_or_path, const std::vector<std::string>& settings) {
  Overrides overrides;
  for (const std::string& text : settings) {
    const Stage::Setting setting = parse_setting(text);
    overrides[setting.name] = setting.value;
  }
  return compile(load_model(name_or_path), overrides);
}

}  // namespace pelage
