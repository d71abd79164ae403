#include "catalog/shapes.h"

#include <algorithm>
#include <optional>

#include "base/suggest.h"
#include "catalog/embedded.h"
#include "catalog/regions.h"
#include "gridgen/generate.h"
#include "gridgen/patches.h"
#include "io/grid_file.h"
#include "io/read_shape.h"
#include "pelage/error.h"
#include "recipe/document.h"
#include "shape/atlas.h"
#include "shape/builtin_grids.h"
#include "shape/generators.h"
#include "shape/grid.h"

namespace pelage {

namespace {

constexpr std::string_view prefix = "builtin:";

/// A text that describes a shape.
struct Description {
  std::string text, file;
  std::optional<std::array<std::int32_t, 2>> nodes;  ///< of a region
  bool patches = false;
  std::int32_t refine = 1;  ///< of patches
};

void take_nodes(const std::string& name, const std::string& parameters, Description& d) {
  if (parameters.empty()) return;
  const auto counts = parameters.starts_with("n=") ? parse_counts(parameters.substr(2), 2) : std::nullopt;
  if (!counts)
    throw Error(Fault::usage, "the parameters \"" + parameters + "\" of builtin:" + name + " must be n=NODESxNODES");
  d.nodes = std::array{(*counts)[0], (*counts)[1]};
}

void take_refinement(const std::string& name, const std::string& parameters, Description& d) {
  constexpr std::int32_t most = 64;
  if (parameters.empty()) return;
  const auto factor = parameters.starts_with("refine=") ? parse_counts(parameters.substr(7), 1) : std::nullopt;
  if (!factor || (*factor)[0] < 1 || (*factor)[0] > most)
    throw Error(Fault::usage, "the parameters \"" + parameters + "\" of builtin:" + name +
                                  " must be refine=N, with N cells for one of the file, 1 to 64");
  d.refine = (*factor)[0];
}

std::optional<Description> built_in(const std::string& path) {
  if (!path.starts_with(prefix)) return {};
  const std::size_t question = std::min(path.find('?'), path.size());
  const std::string name = path.substr(prefix.size(), question - prefix.size()),
                    parameters = path.substr(std::min(question + 1, path.size()));
  if (const EmbeddedFile* f = find_embedded("regions", name)) {
    Description d{std::string(f->text), std::string(f->path), {}};
    take_nodes(name, parameters, d);
    return d;
  }
  if (const EmbeddedFile* f = find_embedded("patches", name)) {
    Description d{std::string(f->text), std::string(f->path), {}, true};
    take_refinement(name, parameters, d);
    return d;
  }
  return {};
}

std::optional<Description> description_of(const std::string& path) {
  if (!path.ends_with(".toml")) return built_in(path);
  Description d{read_text(path), path, {}};
  const Value document = parse_document(d.text, path);
  d.patches = document.find("patch") != nullptr;
  const auto has = [&](const char* key) { return document.find(key) != nullptr; };
  const bool region = has("south") || has("north") || has("outline") || has("bottom") || has("top");
  if (!d.patches && !region) return {};
  return d;
}

ShapeFile made(const Description& d) {
  ShapeFile file;
  if (d.patches) {
    Atlas atlas = parse_patches(d.text, d.file, d.refine);
    file.mesh = mesh_of(atlas);
    file.nodes = std::make_shared<const NodeShape>(std::move(atlas));
    return file;
  }
  GeneratedGrid generated = generate(parse_region(d.text, d.file), {.nodes = d.nodes});
  file.mesh = mesh_of(generated.grid);
  file.findings = std::move(generated.findings);
  file.nodes = std::make_shared<const NodeShape>(std::move(generated.grid));
  return file;
}

/// Of built-in shapes all kinds are known here.
void require_known(const std::string& path) {
  if (!path.starts_with(prefix)) return;
  const std::string name = path.substr(prefix.size(), path.find('?') - prefix.size());
  std::vector<std::string> known = builtin_shape_names();
  for (const auto& more : {builtin_grid_names(), region_names(), patches_names()})
    known.insert(known.end(), more.begin(), more.end());
  if (std::ranges::count(known, name) == 0) throw Error(Fault::usage, unknown_name("built-in shape", name, known));
}

}  // namespace

std::vector<std::string> patches_names() { return embedded_names("patches"); }

ShapeFile find_shape(const std::string& path) {
  if (const auto description = description_of(path)) return made(*description);
  require_known(path);
  return read_shape(path);
}

void check_shape_name(const std::string& path) {
  if (description_of(path)) return;
  require_known(path);
  check_shape_path(path);
}

bool names_grid(const std::string& path) {
  const auto description = description_of(path);
  return description ? !description->patches : is_grid_shape(path);
}

bool names_atlas(const std::string& path) {
  const auto description = description_of(path);
  return description && description->patches;
}

}  // namespace pelage
