// pelage analyse: what linear theory says about a model before anything grows.

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "catalog/analysis.h"
#include "command.h"
#include "io/png_writer.h"
#include "look/dispersion_plot.h"
#include "pelage/io.h"
#include "react/turing_conditions.h"
#include "settings.h"
#include "table.h"
#include "text.h"

namespace pelage {

namespace {

struct AnalyseOptions {
  std::string model, plot;
  std::vector<std::string> settings;
  bool json = false;
};

double fastest_wave_number(const Stability& s) { return 2 * std::numbers::pi / *s.wavelength; }

/// Parameters that are not at the model's own values.
std::string title_of(const std::string& name, const std::vector<std::string>& settings) {
  std::string title = name;
  for (const std::string& s : settings) title += ", " + s;
  return title;
}

// --- for people -------------------------------------------------------------------------------------------

/// At a threshold only rounding is left of a growth rate.
std::string growth_text(const Stability& s) {
  return regime_of(s) == Regime::marginal ? "0 (at the threshold)" : number(s.growth);
}

/// A band may begin at k = 0 (the uniform state is unstable, too) and need not end.
std::string band_text(const Stability& s) {
  const bool from_zero = growth_rate(s, *s.band_min / 2).real() > 0;
  const bool endless = growth_rate(s, *s.band_max * 2).real() > 0;
  if (endless) return from_zero ? "all wave numbers" : "k above " + number(*s.band_min);
  const double shortest = 2 * std::numbers::pi / *s.band_max;
  if (from_zero) return "k up to " + number(*s.band_max) + ", wavelengths from " + number(shortest);
  return "k from " + number(*s.band_min) + " to " + number(*s.band_max) + ", wavelengths from " + number(shortest) +
         " to " + number(2 * std::numbers::pi / *s.band_min);
}

std::string complex_number(std::complex<double> z) {
  const double tiny = 1e-12 * std::abs(z);
  if (std::abs(z.imag()) <= tiny) return brief(z.real());
  return brief(z.real()) + (z.imag() > 0 ? " + " : " - ") + brief(std::abs(z.imag())) + " i";
}

std::string eigenvalue_list(const Stability& s) {
  std::string text;
  for (const auto& z : s.eigenvalues) text += (text.empty() ? "" : ", ") + complex_number(z);
  return text;
}

std::string verdict_at_zero(const Stability& s) {
  switch (regime_of(s)) {
    case Regime::oscillation:
    case Regime::departure:
    case Regime::mixed:
      return "unstable";
    default:
      return "stable";
  }
}

std::string verdict_of_waves(const Stability& s) {
  if (s.band_min) return "grow, " + brief(*s.wavelength) + " long";
  if (regime_of(s) == Regime::ever_shorter) return "grow, the shorter the faster";
  return regime_of(s) == Regime::marginal ? "neither" : "decay";
}

void print_states(const Analysis& a) {
  std::puts("\nSteady states");
  std::vector<std::vector<std::string>> rows = {{""}};
  rows[0].insert(rows[0].end(), a.species.begin(), a.species.end());
  for (const char* heading : {"UNIFORM", "WAVES", "EIGENVALUES"}) rows[0].push_back(heading);
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    std::vector<std::string> row = {std::to_string(i + 1) + (i == a.stability.chosen ? "*" : "")};
    for (const double value : a.stability.steady_states[i]) row.push_back(number(value));
    for (const std::string& text :
         {verdict_at_zero(a.states[i]), verdict_of_waves(a.states[i]), eigenvalue_list(a.states[i])})
      row.push_back(text);
    rows.push_back(row);
  }
  std::fputs(table(rows, 2).c_str(), stdout);
  if (a.states.size() > 1) std::puts("  * nearest to the initial values; what follows is about it");
}

void print_jacobian(const Analysis& a) {
  std::puts("\nJacobian and diffusions there");
  std::vector<std::vector<std::string>> rows = {{""}};
  for (const std::string& s : a.species) rows[0].push_back("d/d" + s);
  rows[0].push_back("DIFFUSION");
  const std::size_t n = a.species.size();
  const std::vector<double>&cross = a.stability.cross, &fluxes = a.stability.fluxes;
  if (!cross.empty())
    for (const std::string& s : a.species) rows[0].push_back("OF lap(" + s + ")");
  if (!fluxes.empty())
    for (const std::string& s : a.species) rows[0].push_back("FLUX OF grad " + s);
  for (std::size_t i = 0; i < n; ++i) {
    rows.push_back({"R_" + a.species[i]});
    for (std::size_t j = 0; j < n; ++j)  // + 0.0: no negative zeros
      rows.back().push_back(number(a.stability.jacobian[i * n + j] + 0.0));
    rows.back().push_back(number(a.stability.diffusion[i]));
    for (std::size_t j = 0; j < n && !cross.empty(); ++j)
      rows.back().push_back(i == j ? "" : number(cross[i * n + j] + 0.0));
    for (std::size_t j = 0; j < n && !fluxes.empty(); ++j) rows.back().push_back(number(fluxes[i * n + j] + 0.0));
  }
  std::fputs(table(rows, 2).c_str(), stdout);
}

void print_waves(const Analysis& a) {
  const Stability& s = a.stability;
  std::puts("\nWaves (lengths and times in the model's units)");
  std::vector<std::vector<std::string>> rows;
  if (s.wavelength) {
    const std::complex<double> sigma = growth_rate(s, fastest_wave_number(s));
    rows.push_back({"fastest wavelength", number(*s.wavelength) + " (k = " + number(fastest_wave_number(s)) + ")"});
    rows.push_back({"its growth rate", growth_text(s)});
    rows.push_back({"oscillates", sigma.imag() == 0 ? "no" : "yes, with frequency " + number(std::abs(sigma.imag()))});
  } else {
    rows.push_back({"fastest wavelength", "none: growth has no maximum at a finite wavelength"});
  }
  if (s.band_min) rows.push_back({"unstable band", band_text(s)});
  if (a.spacing_stated)
    rows.push_back({"spacing of patterns", a.spacing ? number(*a.spacing) + " (measured on finished patterns)"
                                                     : "unknown with these parameters"});
  std::fputs(table(rows, 2).c_str(), stdout);
}

void print_conditions(const Analysis& a) {
  std::puts("\nConditions for a Turing pattern");
  for (const Condition& c : a.conditions) std::printf("  %-4s %s\n", c.holds ? "yes" : "no", c.text.c_str());
  for (const std::string& line : a.thresholds_in_words) std::printf("  %s\n", line.c_str());
}

/// Of models without a wavelength of their own.
void print_sizing(const Analysis& a) {
  constexpr double share = 0.01;  // of the diagonal; patterns are some times as large
  std::fputs("\nSizes: no wavelength is known, so give --unit, the length of a model unit, instead of --size", stdout);
  if (a.resolved)
    std::printf("; --unit %s lets fronts be 0.01 of the diagonal wide, waves some times that",
                brief(share / *a.resolved).c_str());
  std::puts("");
}

void print_limits(const Analysis& a) {
  if (a.largest_steps.empty()) return print_sizing(a);
  std::printf("\nLargest stable steps, for %s control vertices per wavelength of %s\n", number(a.resolution).c_str(),
              number(*a.spacing).c_str());
  std::vector<std::vector<std::string>> rows;
  for (const StepLimit& limit : a.largest_steps)
    rows.push_back({limit.stepper, std::isfinite(limit.step) ? number(limit.step) : "any"});
  std::fputs(table(rows, 2).c_str(), stdout);
}

void print_analysis(const Analysis& a, const std::string& title) {
  std::printf("%s: %s\n", title.c_str(), a.title.c_str());
  std::fputs(wrapped(a.verdict, 2).c_str(), stdout);
  if (a.states.empty()) return;
  print_states(a);
  print_jacobian(a);
  print_waves(a);
  print_conditions(a);
  print_limits(a);
}

// --- for programs -----------------------------------------------------------------------------------------

Json by_species(const Analysis& a, const std::vector<double>& values) {
  Json object = Json::object();
  for (std::size_t i = 0; i < a.species.size(); ++i) object[a.species[i]] = json_number(values[i]);
  return object;
}

Json state_json(const Analysis& a, std::size_t i) {
  const Stability& s = a.states[i];
  Json eigenvalues = Json::array(), jacobian = Json::array();
  for (const auto& z : s.eigenvalues) eigenvalues.push_back({json_number(z.real()), json_number(z.imag())});
  for (const double x : s.jacobian) jacobian.push_back(json_number(x));
  return {{"values", by_species(a, s.steady_states[0])},
          {"chosen", i == a.stability.chosen},
          {"uniform", verdict_at_zero(s)},
          {"eigenvalues", eigenvalues},
          {"jacobian_by_rows", jacobian},
          {"diffusion", by_species(a, s.diffusion)},
          {"regime", describe(regime_of(s))},
          {"wavelength", json_number(s.wavelength)},
          {"growth", json_number(s.growth)},
          {"oscillatory", s.oscillatory},
          {"band", s.band_min ? Json{json_number(*s.band_min), json_number(*s.band_max)} : Json(nullptr)}};
}

Json to_json(const Analysis& a, const std::string& name, const std::vector<ParameterSource>& in_use) {
  Json states = Json::array(), conditions = Json::array(), thresholds = Json::array(), steps = Json::object();
  for (std::size_t i = 0; i < a.states.size(); ++i) states.push_back(state_json(a, i));
  for (const Condition& c : a.conditions) conditions.push_back({{"text", c.text}, {"holds", c.holds}});
  for (const DiffusionThreshold& t : a.thresholds)
    thresholds.push_back(
        {{"species", a.species[t.species]}, {"diffusion", t.diffusion}, {"grows", t.grows_above ? "above" : "below"}});
  for (const StepLimit& limit : a.largest_steps) steps[limit.stepper] = json_number(limit.step);
  Json parameters = Json::object();
  for (const ParameterSource& p : in_use) parameters[p.name] = json_number(p.value);
  return {{"model", name},
          {"parameters", parameters},
          {"regime", a.verdict},
          {"steady_states", states},
          {"conditions", conditions},
          {"thresholds", thresholds},
          {"wavelength", json_number(a.spacing)},
          {"resolved_length", json_number(a.resolved)},
          {"largest_steps", steps}};
}

void write_plot(const Analysis& a, const std::string& title, const std::string& path) {
  if (a.states.empty())
    throw Error(Fault::usage,
                "no steady state was found, hence there is no dispersion relation to plot; leave out --plot");
  write_png(draw(dispersion_plot(a.stability, title, a.verdict)), path);
}

void analyse_command(const AnalyseOptions& options) {
  if (!options.plot.empty()) check_picture_path(options.plot);
  const Model model = load_model_with(options.model, options.settings);
  const Analysis a = analysis_of(model);
  const std::string title = title_of(options.model, options.settings);
  if (!options.plot.empty()) write_plot(a, title, options.plot);
  if (options.json)
    print_json(to_json(a, options.model, model.parameters()));
  else
    print_analysis(a, title);
}

}  // namespace

Command add_analyse(CLI::App& parent) {
  auto options = std::make_shared<AnalyseOptions>();
  CLI::App* app = parent.add_subcommand(
      "analyse",
      "Say what linear theory knows about a model\n"
      "Steady states and their stability, the waves that grow out of them, how far the diffusions are from the "
      "threshold of a pattern, and the largest steps that the time steppers stand.");
  app->add_option("MODEL", options->model, "A model, MODEL:VARIANT, or the path of a model's .toml file")
      ->type_name("")
      ->required();
  add_settings_option(*app, options->settings);
  app->add_option("--plot", options->plot, "File for a plot of growth over wave number: .png")->type_name("FILE");
  app->add_flag("--json", options->json, "Print the result as JSON");
  app->footer(
      "Examples:\n"
      "  pelage analyse turing --set Da=0.15 --plot growth.png\n"
      "  pelage analyse gray-scott --set F=0.03,k=0.055 --json");
  return {app, [options] { analyse_command(*options); }};
}

}  // namespace pelage
