#include "look/layers.h"

#include <algorithm>

#include "base/parallel.h"
#include "look/ramp.h"
#include "react/place_formula.h"

namespace pelage {

namespace {

std::vector<double> values_of(const Given<std::string>& formula, const std::vector<std::string>& species,
                              const Places& places) {
  std::vector<DefinitionSource> fields;
  for (const std::string& name : species)
    if (name.find('.') == std::string::npos) fields.push_back({name, {"attribute(" + name + ")", formula.where}});
  return PlaceFormula({formula.value, formula.where}, std::move(fields)).at(places);
}

/// What a text means, or a fault with its place.
template <class Meaning>
auto located(const Given<std::string>& text, Meaning&& meaning) {
  try {
    return meaning(text.value);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), text.where);
  }
}

/// The colour of a layer at every sample, or one for all.
std::vector<Color> layer_colors(const Layer& layer, const std::vector<std::string>& species, const Places& places) {
  if (layer.color) return {located(*layer.color, parse_hex_color)};
  const Ramp ramp = located(*layer.ramp, named_ramp);
  std::vector<Color> colors;
  for (const double v : values_of(layer.value, species, places))
    colors.push_back(ramp(std::clamp((v - layer.low) / (layer.high - layer.low), 0.0, 1.0)));
  return colors;
}

}  // namespace

void paint(const std::vector<Layer>& layers, const std::vector<std::string>& species, const Places& places,
           std::vector<double>& colors) {
  const std::size_t count = places.positions.size();
  for (const Layer& layer : layers) {
    const std::vector<Color> paint = layer_colors(layer, species, places);
    const std::vector<double> opacity =
        layer.opacity ? values_of(*layer.opacity, species, places) : std::vector<double>(count, 1);
    parallel_for(count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Color& top = paint[layer.color ? 0 : i];
        const double share = opacity[i] > 0 ? std::min(opacity[i], 1.0) : 0;
        for (std::size_t c = 0; c < 3; ++c) colors[3 * i + c] += share * (top[c] - colors[3 * i + c]);
      }
    });
  }
}

}  // namespace pelage
