#include "look/palette.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/parallel.h"
#include "base/quantile.h"
#include "base/suggest.h"
#include "pelage/error.h"
#include "react/place_values.h"

namespace pelage {

namespace {

/// The ends of the ramp are quantiles, so that a few extreme samples do not bleach the rest.
constexpr double ramp_quantile = 0.005;

/// What a text means, or a fault with its place.
template <class Meaning>
auto located(const Given<std::string>& text, Meaning&& meaning) {
  try {
    return meaning(text.value);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), text.where);
  }
}

std::size_t shown_species(const std::vector<std::string>& species, const Look& look) {
  if (!look.species) return species.size() - 1;
  const auto found = std::ranges::find(species, look.species->value);
  if (found == species.end())
    throw Error(Fault::usage, unknown_name("species", look.species->value, species), look.species->where);
  return static_cast<std::size_t>(found - species.begin());
}

PaintLayer resolve_layer(const Layer& layer, const std::vector<std::string>& species) {
  PaintLayer result;
  if (layer.color) result.color = located(*layer.color, parse_hex_color);
  if (layer.ramp) {
    result.ramp = RampTable(located(*layer.ramp, named_ramp));
    result.value = layer_formula(layer.value, species);
  }
  result.low = layer.low;
  result.high = layer.high;
  if (layer.opacity) result.opacity = layer_formula(*layer.opacity, species);
  return result;
}

Places places_of(const CoatSamples& s, const std::vector<std::string>& species) {
  Places places{.positions = s.position, .normals = s.normal, .k1 = s.curvature.k1, .k2 = s.curvature.k2};
  for (const auto& [name, values] : s.attributes) places.attributes[name] = values;
  for (std::size_t i = 0; i < species.size(); ++i) {
    const auto hidden = places.attributes.find(species[i]);
    if (hidden != places.attributes.end()) places.attributes[input_name(species[i])] = hidden->second;
    places.attributes[species[i]] = s.fields[i];
  }
  places.length_unit = s.length_unit;
  places.origin = s.origin;
  places.period = s.period;
  places.box = s.box;
  return places;
}

/// The samples as formulas see them. Random fields are drawn where the samples were at first.
struct SamplePlaces {
  SamplePlaces(const CoatSamples& samples, const Paint& paint) : places(places_of(samples, paint.species)) {
    if (samples.drawn_at.empty()) return;
    Places drawn_at = places;
    drawn_at.positions = samples.drawn_at;
    drawn = draw_random_fields(paint.symbols(), drawn_at, samples.seed);
    places.drawn = drawn;
  }
  SamplePlaces(const SamplePlaces&) = delete;
  SamplePlaces& operator=(const SamplePlaces&) = delete;

  Places places;
  std::vector<DrawnField> drawn;
};

std::vector<double> ramp_colors(const std::vector<double>& field, const Palette& palette) {
  const double low = palette.low, high = palette.high;
  std::vector<double> values(3 * field.size());
  parallel_for(field.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double place = high > low ? std::clamp((field[i] - low) / (high - low), 0.0, 1.0) : 0.5;
      const Color color = palette.paint.ramp(palette.paint.invert ? 1 - place : place);
      std::copy(color.begin(), color.end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  });
  return values;
}

void paint_layer(const PaintLayer& layer, const Places& places, std::uint64_t seed, std::vector<double>& colors) {
  const std::size_t count = places.positions.size();
  const std::vector<double> value = layer.value ? layer.value->at(places, seed) : std::vector<double>{};
  const std::vector<double> opacity = layer.opacity ? layer.opacity->at(places, seed) : std::vector<double>(count, 1);
  parallel_for(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Color top = layer.ramp
                            ? (*layer.ramp)(std::clamp((value[i] - layer.low) / (layer.high - layer.low), 0.0, 1.0))
                            : layer.color;
      const double share = opacity[i] > 0 ? std::min(opacity[i], 1.0) : 0;
      for (std::size_t c = 0; c < 3; ++c) colors[3 * i + c] += share * (top[c] - colors[3 * i + c]);
    }
  });
}

std::vector<double> finite_values(const CoatSamples& samples, const Paint& paint, const ChannelFormula& formula,
                                  const std::string& what) {
  std::vector<double> values = formula.value.at(SamplePlaces(samples, paint).places, samples.seed);
  for (const double x : values)
    if (!std::isfinite(x)) throw Error(Fault::numerics, what + " is " + number(x) + " somewhere", formula.where);
  return values;
}

/// Before they are clamped, lengths in sizes of the pattern.
std::vector<double> raw_channel(const CoatSamples& samples, const Paint& paint, Channel channel) {
  return finite_values(samples, paint, paint.channels.at(channel), "the " + std::string(kind_of(channel).name));
}

}  // namespace

PlaceFormula layer_formula(const Given<std::string>& text, const std::vector<std::string>& species) {
  std::vector<std::string> own;
  for (const std::string& name : species)
    if (name.find('.') == std::string::npos) own.push_back(name);
  return PlaceFormula({text.value, text.where}, own);
}

std::vector<double> formula_values(const PlaceFormula& formula, const CoatSamples& samples, const Paint& paint) {
  return formula.at(SamplePlaces(samples, paint).places, samples.seed);
}

std::vector<Symbol> Paint::symbols() const {
  std::vector<Symbol> all;
  const auto add = [&](const PlaceFormula& formula) {
    for (Symbol& s : formula.symbols()) all.push_back(std::move(s));
  };
  for (const PaintLayer& layer : layers)
    for (const auto* formula : {&layer.value, &layer.opacity})
      if (*formula) add(**formula);
  for (const auto& [channel, formula] : channels) add(formula.value);
  if (holes) add(holes->value);
  return all;
}

Paint resolve_paint(const Look& look, std::vector<std::string> species) {
  const std::string& ramp = look.ramp.value;
  if (!ramp.empty() && std::ranges::count(ramp_names(), ramp) == 0)
    throw Error(Fault::usage, unknown_name("ramp", ramp, ramp_names()), look.ramp.where);
  Paint paint{std::move(species), 0,           RampTable(named_ramp(ramp.empty() ? "tawny" : ramp)),
              look.invert,        look.fields, {}};
  for (const Layer& layer : look.layers) paint.layers.push_back(resolve_layer(layer, paint.species));
  for (const auto& [channel, text] : look.channels)
    paint.channels.emplace(channel, ChannelFormula{layer_formula(text, paint.species), text.where});
  paint.displace = look.displace;
  paint.shown = shown_species(paint.species, look);
  return paint;
}

Palette make_palette(Paint paint, const CoatSamples& samples, const std::vector<char>& uniform) {
  Palette palette{std::move(paint), 0, 0};
  const std::size_t shown = palette.paint.shown;
  if (uniform[shown]) return palette;
  std::vector<double> sorted = samples.fields[shown];
  palette.low = quantile(sorted, ramp_quantile);
  palette.high = quantile(sorted, 1 - ramp_quantile);
  return palette;
}

std::vector<double> paint(const CoatSamples& samples, const Palette& palette) {
  std::vector<double> colors = ramp_colors(samples.fields[palette.paint.shown], palette);
  if (palette.paint.layers.empty()) return colors;
  const SamplePlaces at(samples, palette.paint);
  for (const PaintLayer& layer : palette.paint.layers) paint_layer(layer, at.places, samples.seed, colors);
  return colors;
}

std::vector<double> channel_values(const CoatSamples& samples, const Paint& paint, Channel channel) {
  const ChannelKind& kind = kind_of(channel);
  const double unit = kind.length ? samples.wavelength : 1;
  std::vector<double> values = raw_channel(samples, paint, channel);
  for (double& x : values) x = unit * std::clamp(x, kind.low, kind.high);
  return values;
}

std::vector<double> hole_values(const CoatSamples& samples, const Paint& paint) {
  return finite_values(samples, paint, *paint.holes, "what the condition compares");
}

ChannelFormula condition_on_coat(const Given<std::string>& text, const std::vector<std::string>& species) {
  const std::optional<PlaceFormula> margin = layer_formula(text, species).margin();
  if (!margin)
    throw Error(Fault::usage, "expected a condition, for example \"" + species.back() + " < 0.5\"", text.where);
  return {*margin, text.where};
}

std::vector<std::string> clamped_channels(const CoatSamples& samples, const Paint& paint) {
  std::vector<std::string> lines;
  for (const auto& [channel, formula] : paint.channels) {
    const ChannelKind& kind = kind_of(channel);
    const auto [low, high] = std::ranges::minmax(raw_channel(samples, paint, channel));
    if (low >= kind.low && high <= kind.high) continue;
    const std::string was = low == high ? " is " + number(low) : " runs from " + number(low) + " to " + number(high);
    lines.push_back("the " + std::string(kind.name) + was + "; it was clamped to " +
                    (kind.high < no_bound ? "0 to 1" : "0 and more"));
  }
  return lines;
}

}  // namespace pelage
