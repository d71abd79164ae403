// pelage models: what can be grown.

#include "catalog/models.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "catalog/skeleton.h"
#include "command.h"
#include "io/atomic_file.h"
#include "outputs.h"
#include "react/stability.h"
#include "react/wavelength.h"
#include "table.h"
#include "text.h"

namespace pelage {

namespace {

/// A model, compiled and analysed.
struct Entry {
  std::string name;
  Model model;
  Stability stability;
  std::optional<double> wavelength;  ///< the one that --size stretches
};

Entry make_entry(const std::string& name, const ModelSource& source) {
  Entry entry{name, compile(source), {}, {}};
  entry.stability = analyse(entry.model);
  entry.wavelength = known_wavelength(entry.model);
  return entry;
}

std::vector<Entry> entries(const std::string& name) {
  std::vector<Entry> list;
  if (!name.empty()) return {make_entry(name, load_model(name))};
  for (const ModelEntry& entry : model_list()) list.push_back(make_entry(entry.name, entry.source));
  return list;
}

std::string text_or(const std::optional<double>& value, const std::string& otherwise) {
  return value ? number(*value) : otherwise;
}

// --- for people -------------------------------------------------------------------------------------------

void print_list(const std::vector<Entry>& list) {
  std::vector<std::vector<std::string>> rows = {{"NAME", "WAVELENGTH", "TITLE"}};
  for (const Entry& e : list) rows.push_back({e.name, text_or(e.wavelength, "-"), e.model.source().title});
  std::fputs(table(rows).c_str(), stdout);
  std::puts("\nWavelengths are in the model's own length unit; grow --size sets what they become on a shape.");
  std::puts("pelage models NAME shows equations and parameters.");
}

/// The formula as a factor of a product.
std::string in_brackets(const Formula& f) {
  return f.text.find_first_of("+-*/^ ") == std::string::npos ? f.text : "(" + f.text + ")";
}

/// The formula as a further term of a sum.
std::string plus(const Formula& f) { return f.text.starts_with('-') ? " - " + f.text.substr(1) : " + " + f.text; }

std::string entries(const TensorSource& tensor) {
  std::string text;
  for (const Formula& f : tensor) text += (text.empty() ? "" : "; ") + f.text;
  return text;
}

/// The component for which the formulas of a vector are read; 0: each component has its own, or it is no vector.
int component_of(const SpeciesSource& s) {
  for (const auto* f : {&s.rate, &s.equals, &s.c2, &s.c3})
    if (*f) return (*f)->component;
  return 0;
}

/// "du/dt = div(Du grad u) + R" with the formulas of the file.
std::string equation(const SpeciesSource& s) {
  const std::string& name = component_of(s) > 0 ? s.vector : s.name;
  if (s.equals) return name + " = " + s.equals->text;
  std::string text = "d" + name + "/dt = ";
  if (!s.diffusion && !s.anisotropy && !s.tensor && !s.c0 && !s.c1) return text + s.rate->text;
  if (s.tensor)
    text += (s.c0 ? in_brackets(*s.c0) + " " : "") + "div(T[" + entries(*s.tensor) + "] grad " + name + ")";
  else if (s.anisotropy)
    text += "div(A[" + s.anisotropy->theta.text + "; " + s.anisotropy->a1.text + "; " + s.anisotropy->a2.text +
            "] grad " + name + ")";
  else if (s.diffusion)
    text += "div(" + in_brackets(*s.diffusion) + " grad " + name + ")";
  else
    text +=
        (s.c0 ? in_brackets(*s.c0) + " " : "") + "div(" + (s.c1 ? in_brackets(*s.c1) + " " : "") + "grad " + name + ")";
  if (s.rate) text += plus(*s.rate);
  if (s.c2) text += " + " + in_brackets(*s.c2) + " " + name;
  if (s.c3) text += plus(*s.c3);
  return text;
}

void print_equations(const ModelSource& source) {
  std::puts("\nEquations");
  std::vector<std::vector<std::string>> starts;
  for (const SpeciesSource& s : source.species) {
    if (component_of(s) <= 1) std::printf("  %s\n", equation(s).c_str());
    std::string bounds;
    if (s.lower) bounds += ", at least " + s.lower->text;
    if (s.upper) bounds += ", at most " + s.upper->text;
    const int component = s.initial ? s.initial->component : 0;
    if (s.equals || component > 1) continue;
    starts.push_back(
        {(component > 0 ? s.vector : s.name) + " = " + (s.initial ? s.initial->text : "0") + " at the start" + bounds});
  }
  for (const DefinitionSource& d : source.definitions)
    std::printf("  with %s = %s\n", d.name.c_str(), d.formula.text.c_str());
  std::fputs(table(starts, 2).c_str(), stdout);
}

std::string range(const ParameterSource& p) {
  const std::string low = std::isfinite(p.min) ? number(p.min) : "", high = std::isfinite(p.max) ? number(p.max) : "";
  return low.empty() && high.empty() ? "any" : low + " .. " + high;
}

void print_parameters(const Model& model) {
  std::puts("\nParameters (--set NAME=VALUE)");
  std::vector<std::vector<std::string>> rows = {{"NAME", "VALUE", "RANGE", "UNIT", "MEANING"}};
  for (const ParameterSource& p : model.parameters())
    rows.push_back({p.name, number(p.value), range(p), p.unit.empty() ? "1" : p.unit, p.help});
  std::fputs(table(rows, 2).c_str(), stdout);
}

std::string steady_state(const Entry& e) {
  const auto& states = e.stability.steady_states;
  if (states.empty()) return "none found";
  std::string text;
  for (std::size_t i = 0; i < e.model.species_count(); ++i)
    text += (i ? ", " : "") + e.model.species_name(i) + " = " + number(states[e.stability.chosen][i]);
  return text;
}

/// Below the rounding of the analysis a state is marginal.
std::string growth(const Stability& s) {
  constexpr double rounding = 1e-12;
  return (std::abs(s.growth) < rounding ? "0" : number(s.growth)) + " per time" +
         (s.oscillatory ? ", oscillating" : "");
}

/// With its formula as it goes on from there, and where it comes from.
std::string wavelength_text(const Entry& e) {
  const ModelSource& source = e.model.source();
  std::string text = text_or(e.wavelength, "none");
  if (source.wavelength_law) text += (source.wavelength ? ", else as " : " = ") + source.wavelength_law->text;
  return text + (states_wavelength(source) ? " (measured on finished patterns)" : "");
}

void print_analysis(const Entry& e) {
  const Suggestions& suggested = e.model.source().suggestions;
  std::puts("\nAnalysis (lengths and times in the model's units)");
  const std::vector<std::vector<std::string>> rows = {
      {"steady state", steady_state(e)},
      {"critical wavelength", text_or(e.stability.wavelength, "none: the uniform state has no fastest wave")},
      {"fastest growth", growth(e.stability)},
      {"wavelength used", wavelength_text(e)},
      {"time to a pattern", text_or(suggested.end, "not given")},
      {"largest step", text_or(suggested.step, "not given")},
      {"resolution", number(suggested.resolution_or_default()) + " vertices per wavelength at least"}};
  std::fputs(table(rows, 2).c_str(), stdout);
}

void print_entry(const Entry& e) {
  const ModelSource& source = e.model.source();
  std::printf("%s: %s\n", e.name.c_str(), source.title.c_str());
  if (!source.summary.empty()) std::fputs(wrapped(source.summary, 2).c_str(), stdout);
  if (!source.cite.empty()) std::fputs(("  After " + wrapped(source.cite, 2).substr(2)).c_str(), stdout);
  print_equations(source);
  print_parameters(e.model);
  print_analysis(e);
  if (source.variants.empty()) return;
  std::puts("\nVariants");
  std::vector<std::vector<std::string>> rows;
  for (const VariantSource& v : source.variants) rows.push_back({source.name + ":" + v.name, v.title});
  std::fputs(table(rows, 2).c_str(), stdout);
}

// --- for programs -----------------------------------------------------------------------------------------

Json formula(const std::optional<Formula>& f) { return f ? Json(f->text) : Json(nullptr); }

Json anisotropy(const std::optional<AnisotropySource>& a) {
  return a ? Json{{"theta", a->theta.text}, {"a1", a->a1.text}, {"a2", a->a2.text}} : Json(nullptr);
}

Json tensor(const std::optional<TensorSource>& t) {
  if (!t) return nullptr;
  Json entries;
  for (std::size_t k = 0; k < t->size(); ++k) entries[tensor_entries[k]] = (*t)[k].text;
  return entries;
}

Json to_json(const SpeciesSource& s) {
  return {{"name", s.name},
          {"vector", s.vector.empty() ? Json(nullptr) : Json(s.vector)},
          {"diffusion", formula(s.diffusion)},
          {"anisotropy", anisotropy(s.anisotropy)},
          {"tensor", tensor(s.tensor)},
          {"rate", formula(s.rate)},
          {"equals", formula(s.equals)},
          {"C0", formula(s.c0)},
          {"C1", formula(s.c1)},
          {"C2", formula(s.c2)},
          {"C3", formula(s.c3)},
          {"initial", formula(s.initial)},
          {"min", formula(s.lower)},
          {"max", formula(s.upper)}};
}

Json to_json(const ParameterSource& p) {
  return {{"name", p.name},
          {"value", json_number(p.value)},
          {"min", json_number(p.min)},
          {"max", json_number(p.max)},
          {"unit", p.unit},
          {"help", p.help}};
}

Json steady_state_json(const Entry& e) {
  if (e.stability.steady_states.empty()) return nullptr;
  Json state = Json::object();
  for (std::size_t i = 0; i < e.model.species_count(); ++i)
    state[e.model.species_name(i)] = json_number(e.stability.steady_states[e.stability.chosen][i]);
  return state;
}

Json to_json(const Entry& e) {
  const ModelSource& source = e.model.source();
  Json species = Json::array(), parameters = Json::array(), definitions = Json::array();
  for (const SpeciesSource& s : source.species) species.push_back(to_json(s));
  for (const ParameterSource& p : e.model.parameters()) parameters.push_back(to_json(p));
  for (const DefinitionSource& d : source.definitions)
    definitions.push_back({{"name", d.name}, {"formula", d.formula.text}});
  return {{"name", e.name},
          {"title", source.title},
          {"summary", source.summary},
          {"cite", source.cite},
          {"species", species},
          {"definitions", definitions},
          {"parameters", parameters},
          {"wavelength", json_number(e.wavelength)},
          {"wavelength_formula", source.wavelength_law ? Json(source.wavelength_law->text) : Json(nullptr)},
          {"critical_wavelength", json_number(e.stability.wavelength)},
          {"growth", json_number(e.stability.growth)},
          {"oscillatory", e.stability.oscillatory},
          {"steady_state", steady_state_json(e)},
          {"suggested",
           {{"step", json_number(source.suggestions.step)},
            {"end", json_number(source.suggestions.end)},
            {"tolerance", json_number(source.suggestions.tolerance)},
            {"resolution", source.suggestions.resolution_or_default()},
            {"iterations", json_number(source.suggestions.iterations)}}}};
}

struct ModelsOptions {
  std::string name, begun;
  bool json = false;
};

/// Writes NAME.toml.
void begin_model(std::string name) {
  if (name.ends_with(".toml")) name.erase(name.size() - 5);
  const std::string path = name + ".toml";
  const std::string text = model_skeleton(name);
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) throw Error(Fault::output, "exists already; give another name", {path});
  write_file(path, text);
  publish_outputs();
  print_written({path});
  std::printf("try       pelage analyse %s\n", path.c_str());
  std::printf("          pelage grow builtin:animal --model %s -o %s.glb --picture %s.png\n", path.c_str(),
              name.c_str(), name.c_str());
}

void models(const ModelsOptions& options) {
  if (!options.begun.empty()) return begin_model(options.begun);
  const std::vector<Entry> list = entries(options.name);
  if (options.json) {
    Json array = Json::array();
    for (const Entry& e : list) array.push_back(to_json(e));
    print_json(array);
  } else if (options.name.empty()) {
    print_list(list);
  } else {
    print_entry(list.front());
  }
}

}  // namespace

Command add_models(CLI::App& parent) {
  auto options = std::make_shared<ModelsOptions>();
  CLI::App* app = parent.add_subcommand(
      "models",
      "List the reaction models, or show one with its equations\n"
      "Without NAME: a table of the built-in models and their variants. With NAME: equations, "
      "parameters with ranges and units, steady state and wavelength, and where the model comes from.");
  CLI::Option* name =
      app->add_option("NAME", options->name, "A model, MODEL:VARIANT, or the path of a model's .toml file")
          ->type_name("");
  app->add_option("--new", options->begun,
                  "Write NAME.toml, a model of your own to go on from, with all keys explained")
      ->type_name("NAME")
      ->excludes(name);
  app->add_flag("--json", options->json, "Print the result as JSON: an array of models");
  app->footer(
      "Examples:\n  pelage models\n  pelage models gray-scott:spots\n  pelage models --json\n  pelage models --new "
      "mine");
  return {app, [options] { models(*options); }};
}

}  // namespace pelage
