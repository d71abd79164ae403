#include "settings.h"

#include "catalog/models.h"
#include "recipe/setting.h"

namespace pelage {

CLI::Option* add_settings_option(CLI::App& app, std::vector<std::string>& settings) {
  return app.add_option("--set", settings, "Parameter of the model; give it once per parameter")
      ->type_name("PARAM=VALUE")
      ->delimiter(',')
      ->allow_extra_args(false);
}

Model load_model_with(const std::string& name_or_path, const std::vector<std::string>& settings) {
  Overrides overrides;
  for (const std::string& text : settings) {
    const Stage::Setting setting = parse_setting(text, "--set");
    overrides[setting.name] = setting.value;
  }
  return compile(load_model(name_or_path), overrides);
}

}  // namespace pelage
