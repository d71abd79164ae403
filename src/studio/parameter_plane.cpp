#include "studio/parameter_plane.h"

#include <array>
#include <limits>

#include "base/parallel.h"
#include "base/suggest.h"
#include "catalog/plan.h"
#include "look/dress.h"
#include "look/flat_tile.h"
#include "pelage/error.h"
#include "react/stability.h"
#include "react/turing_conditions.h"
#include "studio/catalogue.h"
#include "studio/node_view.h"

namespace pelage {

namespace {

constexpr std::array regimes = {Regime::no_state,  Regime::quiet, Regime::marginal,
                                Regime::turing,    Regime::waves, Regime::oscillation,
                                Regime::departure, Regime::mixed, Regime::ever_shorter};
constexpr std::uint8_t out_of_range = 255;

void require_parameter(const ModelSource& model, const std::string& name) {
  std::vector<std::string> names;
  for (const ParameterSource& p : model.parameters) names.push_back(p.name);
  if (std::ranges::count(names, name) == 0) throw Error(Fault::usage, unknown_name("parameter", name, names));
}

ModelSource model_over(const Recipe& recipe, std::size_t stage, const MapAxis& x, const MapAxis& y) {
  ModelSource model = planned_model(recipe, stage).source();
  for (const MapAxis* axis : {&x, &y}) require_parameter(model, axis->parameter);
  if (x.parameter == y.parameter) throw Error(Fault::usage, "a map has two parameters, not " + x.parameter + " twice");
  return model;
}

struct PlaneCell {
  std::uint8_t regime = out_of_range;
  float growth = std::numeric_limits<float>::quiet_NaN(), wavelength = growth;
};

PlaneCell cell_of(const ModelSource& model, const Overrides& parameters) try {
  const Stability s = analyse(compile(model, parameters));
  PlaneCell cell;
  cell.regime = static_cast<std::uint8_t>(std::ranges::find(regimes, regime_of(s)) - regimes.begin());
  if (!s.steady_states.empty()) cell.growth = static_cast<float>(s.growth);
  if (s.band_max && s.wavelength) cell.wavelength = static_cast<float>(*s.wavelength);
  return cell;
} catch (const Error&) {
  return {};
}

/// What a species shows of itself, as `pelage map` draws it: plain where there is no pattern.
Image tile_image(const MapCell& cell, const Recipe& recipe, std::size_t stage, std::size_t texels) {
  Recipe own;
  own.models = recipe.models;
  own.stages = {recipe.stages[stage]};
  Look look = shown_look(own);
  look.flat = true;
  look.detail = 1;  // triangles of two or three pixels
  return flat_tile(dress(cell.fields, look), static_cast<int>(texels));
}

}  // namespace

Message parameter_map(const Recipe& recipe, std::size_t stage, const MapAxis& x, const MapAxis& y) {
  const ModelSource model = model_over(recipe, stage, x, y);
  const auto columns = static_cast<std::size_t>(x.count), count = columns * static_cast<std::size_t>(y.count);
  std::vector<std::uint8_t> regime(count);
  std::vector<float> growth(count), wavelength(count);
  parallel_chunks(count, [&](std::size_t c) {
    const PlaneCell cell = cell_of(model, {{x.parameter, x.at(static_cast<int>(c % columns))},
                                           {y.parameter, y.at(static_cast<int>(c / columns))}});
    regime[c] = cell.regime;
    growth[c] = cell.growth;
    wavelength[c] = cell.wavelength;
  });
  Header words = Header::array();
  for (const Regime r : regimes) words.push_back(describe(r));
  Message m;
  m.header["regimes"] = words;
  m.blocks = {{"regime", std::move(regime)}, {"growth", std::move(growth)}, {"wavelength", std::move(wavelength)}};
  return m;
}

Message map_tile(const Recipe& recipe, std::size_t stage, const MapAxis& x, const MapAxis& y, std::size_t texels,
                 const Progress& progress) {
  MapRequest request;
  request.model = model_over(recipe, stage, x, y);
  request.x = {x.parameter, x.from};
  request.y = {y.parameter, y.from};
  request.species = request.model.species.size() - 1;
  const ParameterMap map = run_map(request, progress);
  const MapCell& cell = map.cells.front();
  static constexpr std::array outcomes = {"pattern", "uniform", "failed"};
  Message m;
  m.header = {{"outcome", outcomes[static_cast<std::size_t>(cell.outcome)]},
              {"message", cell.summary.message},
              {"side", map.side}};
  if (cell.outcome == CellOutcome::failed) return m;
  const Image image = tile_image(cell, recipe, stage, texels);
  m.blocks.push_back({"pixels", as_bytes({image.rgb.begin(), image.rgb.end()})});
  return m;
}

}  // namespace pelage
