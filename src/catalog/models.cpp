#include "catalog/models.h"

#include <algorithm>
#include <charconv>

#include "base/suggest.h"
#include "catalog/embedded.h"
#include "pelage/grow.h"
#include "react/formula.h"
#include "recipe/document.h"
#include "recipe/read_recipe.h"

namespace pelage {

namespace {

/// A formula may be written as a number.
Formula formula(const Value& value) {
  if (value.kind() != Value::Kind::number) return {value.string(), value.text_where()};
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value.number()).ptr;
  return {{buffer, end}, value.where()};
}

std::optional<Formula> optional_formula(const Value& table, const std::string& key) {
  const Value* value = table.find(key);
  return value ? std::optional(formula(*value)) : std::nullopt;
}

std::optional<AnisotropySource> anisotropy(const Value& species) {
  const Value* table = species.find("anisotropy");
  if (!table) return std::nullopt;
  const auto theta = optional_formula(*table, "theta");
  return AnisotropySource{theta ? *theta : Formula{"0", table->where()}, formula(table->at("a1")),
                          formula(table->at("a2"))};
}

/// What lies off the diagonal may be left out.
std::optional<TensorSource> tensor(const Value& species) {
  const Value* table = species.find("tensor");
  if (!table) return std::nullopt;
  TensorSource entries;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const std::string key = tensor_entries[k];
    const Value* value = key[0] == key[1] ? &table->at(key) : table->find(key);
    entries[k] = value ? formula(*value) : Formula{"0", table->where()};
  }
  return entries;
}

constexpr std::size_t components = 3;

void require_components(const Value& list) {
  if (list.items().size() != components) throw Error(Fault::usage, "a vector has three components", list.where());
}

/// Of component k of a vector: from a list of three formulas, or from one in which names of vectors stand for their
/// components. With k = 0 that of a number.
std::optional<Formula> component_formula(const Value& table, const std::string& key, int k) {
  const Value* value = table.find(key);
  if (!value) return std::nullopt;
  if (k > 0 && value->kind() == Value::Kind::array) {
    require_components(*value);
    return formula(value->items()[static_cast<std::size_t>(k - 1)]);
  }
  Formula of_component = formula(*value);
  of_component.component = k;
  return of_component;
}

/// Component k of a vector, or with k = 0 a species that is a number.
SpeciesSource species(const std::string& name, const Value& table, int k) {
  const auto of_component = [&](const char* key) { return component_formula(table, key, k); };
  return {.name = k > 0 ? component_name(name, k) : name,
          .where = table.where(),
          .diffusion = optional_formula(table, "diffusion"),
          .anisotropy = anisotropy(table),
          .tensor = tensor(table),
          .rate = of_component("rate"),
          .equals = of_component("equals"),
          .c0 = optional_formula(table, "C0"),
          .c1 = optional_formula(table, "C1"),
          .c2 = of_component("C2"),
          .c3 = of_component("C3"),
          .initial = of_component("initial"),
          .lower = of_component("min"),
          .upper = of_component("max"),
          .vector = k > 0 ? name : ""};
}

void add_species(const std::string& name, const Value& table, std::vector<SpeciesSource>& list) {
  const Value* vector = table.find("vector");
  if (!vector || !vector->boolean()) return list.push_back(species(name, table, 0));
  for (int k = 1; k <= static_cast<int>(components); ++k) list.push_back(species(name, table, k));
}

/// A list of three formulas is a vector.
void add_definition(const std::string& name, const Value& value, std::vector<DefinitionSource>& list) {
  if (value.kind() != Value::Kind::array) return list.push_back({name, formula(value)});
  require_components(value);
  for (std::size_t k = 0; k < components; ++k)
    list.push_back({component_name(name, static_cast<int>(k + 1)), formula(value.items()[k])});
}

ParameterSource parameter(const std::string& name, const Value& value) {
  ParameterSource result;
  result.name = name;
  result.where = value.where();
  if (value.kind() == Value::Kind::number) {
    result.value = value.number();
    return result;
  }
  result.value = value.at("value").number();
  result.min = value.number_or("min", result.min);
  result.max = value.number_or("max", result.max);
  result.unit = value.string_or("unit", "");
  result.help = value.string_or("help", "");
  return result;
}

Suggestions suggestions(const Value& table) {
  const Value* suggested = table.find("suggested");
  if (!suggested) return {};
  const auto resolution = suggested->optional_number("resolution");
  // With fewer, sharp spots blow up at any step: Schnakenberg's below 5.3 Loop vertices per wavelength.
  if (resolution && !(*resolution >= 6 && *resolution <= 64))
    throw Error(Fault::usage, "a resolution is a number of vertices per wavelength from 6 to 64",
                suggested->at("resolution").where());
  return {suggested->optional_number("step"), suggested->optional_number("end"),
          suggested->optional_number("tolerance"), resolution, suggested->optional_number("iterations")};
}

bool has_number(const Value& table, const std::string& key) {
  const Value* value = table.find(key);
  return value && value->kind() == Value::Kind::number;
}

/// `wavelength` where it is a number.
std::optional<double> wavelength(const Value& table) {
  if (!has_number(table, "wavelength")) return std::nullopt;
  const double value = table.at("wavelength").number();
  if (!(value > 0)) throw Error(Fault::usage, "a wavelength must be greater than 0", table.at("wavelength").where());
  return value;
}

/// `wavelength` where it is a formula.
std::optional<Formula> wavelength_law(const Value& table) {
  return has_number(table, "wavelength") ? std::nullopt : optional_formula(table, "wavelength");
}

VariantSource variant(const std::string& name, const Value& table) {
  VariantSource result{.name = name,
                       .title = table.string_or("title", ""),
                       .parameters = {},
                       .wavelength = wavelength(table),
                       .wavelength_law = wavelength_law(table),
                       .period = optional_formula(table, "period"),
                       .suggestions = suggestions(table),
                       .where = table.where()};
  if (const Value* parameters = table.find("parameters"))
    for (const auto& [key, value] : parameters->entries()) result.parameters[key] = {value->number(), value->where()};
  return result;
}

/// fill(name, value) for every entry of a table of tables, if it is there.
template <class Fill>
void for_entries(const Value& document, const std::string& key, Fill&& fill) {
  if (const Value* table = document.find(key))
    for (const auto& [name, value] : table->entries()) fill(name, *value);
}

Look look_of(const Value& document) {
  const Value* look = document.find("look");
  return look ? read_look(*look) : Look{};
}

ModelSource model(const Value& document) {
  if (!document.find("species") && document.find("stage"))
    throw Error(Fault::usage, "this is a recipe, not a model; give it as --recipe", {document.where().file});
  ModelSource result;
  result.where = document.where();
  result.name = document.at("name").string();
  result.title = document.string_or("title", result.name);
  result.cite = document.string_or("cite", "");
  result.summary = document.string_or("summary", "");
  result.wavelength = wavelength(document);
  result.wavelength_law = wavelength_law(document);
  result.period = optional_formula(document, "period");
  result.suggestions = suggestions(document);
  for_entries(document, "parameters",
              [&](auto& name, auto& value) { result.parameters.push_back(parameter(name, value)); });
  for_entries(document, "definitions",
              [&](auto& name, auto& value) { add_definition(name, value, result.definitions); });
  for_entries(document, "species", [&](auto& name, auto& value) { add_species(name, value, result.species); });
  constexpr std::size_t most_species = 100;  // each of them has a derivative by each, and linear theory a matrix of all
  if (result.species.size() > most_species)
    throw Error(Fault::usage,
                "there are " + std::to_string(result.species.size()) + " species; at most " +
                    std::to_string(most_species) + " are taken",
                result.where);
  for_entries(document, "variants", [&](auto& name, auto& value) { result.variants.push_back(variant(name, value)); });
  look_of(document);
  document.require_all_read();
  return result;
}

std::vector<ModelEntry> read_embedded() {
  std::vector<ModelEntry> list;
  for (const std::string& name : embedded_names("models")) {
    const EmbeddedFile& file = *find_embedded("models", name);
    const ModelSource source = parse_model(file.text, std::string(file.path));
    list.push_back({source.name, source});
    for (const VariantSource& candidate : source.variants)
      list.push_back({source.name + ":" + candidate.name, with_variant(source, candidate.name)});
  }
  return list;
}

ModelSource load_built_in(const std::string& name) {
  std::vector<std::string> all, models;  // with and without variants
  for (const ModelEntry& entry : model_list()) {
    if (entry.name == name) return entry.source;
    all.push_back(entry.name);
    if (entry.name == entry.source.name) models.push_back(entry.name);
  }
  std::string hint = did_you_mean(name, all);
  const std::size_t colon = name.find(':');
  if (hint.empty() && std::ranges::count(models, name.substr(0, colon)) > 0)
    return with_variant(load_built_in(name.substr(0, colon)), name.substr(colon + 1));  // says which there are
  if (std::ranges::count(recipe_names(), name) > 0) hint = "it is a recipe: give it as --recipe " + name;
  throw Error(Fault::usage, "unknown model \"" + name + "\"; " +
                                (hint.empty() ? "there are " + join_names(models) +
                                                    ", each with variants (pelage models "
                                                    "lists them), or give the path of a .toml file"
                                              : hint));
}

const std::string& file_of(const ModelTexts::value_type& own) {
  return own.second.file.empty() ? own.first : own.second.file;
}

}  // namespace

ModelSource parse_model(std::string_view text, const std::string& file) { return model(parse_document(text, file)); }

const std::vector<ModelEntry>& model_list() {
  static const std::vector<ModelEntry> list = read_embedded();
  return list;
}

ModelSource load_model(const std::string& name_or_path) {
  const std::size_t extension = name_or_path.rfind(".toml");
  if (extension == std::string::npos) return load_built_in(name_or_path);
  const std::size_t end = extension + 5;
  if (end == name_or_path.size()) return model(read_document(name_or_path));
  if (name_or_path[end] != ':') return load_built_in(name_or_path);
  return with_variant(model(read_document(name_or_path.substr(0, end))), name_or_path.substr(end + 1));
}

ModelSource find_model(const std::string& name_or_path, const ModelTexts& texts) {
  const std::size_t colon = name_or_path.rfind(':');
  const auto found = texts.find(name_or_path.substr(0, colon));
  if (found == texts.end()) return load_model(name_or_path);
  const ModelSource source = parse_model(found->second.text, file_of(*found));
  return colon == std::string::npos ? source : with_variant(source, name_or_path.substr(colon + 1));
}

Look model_look(const std::string& name_or_path, const ModelTexts& texts) {
  const std::size_t extension = name_or_path.rfind(".toml");
  const std::string name = extension == std::string::npos ? name_or_path.substr(0, name_or_path.find(':'))
                                                          : name_or_path.substr(0, extension + 5);
  if (const auto own = texts.find(name); own != texts.end())
    return look_of(parse_document(own->second.text, file_of(*own)));
  if (const EmbeddedFile* file = find_embedded("models", name))
    return look_of(parse_document(file->text, std::string(file->path)));
  if (extension != std::string::npos) return look_of(read_document(name));
  load_built_in(name);  // says what is wrong with it
  return {};
}

}  // namespace pelage
