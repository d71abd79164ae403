// pelage measure: what the pattern of a finished coat is like.

#include <algorithm>
#include <cstdio>
#include <memory>

#include "catalog/measured_coat.h"
#include "command.h"
#include "input_unit.h"
#include "io/png_writer.h"
#include "look/plot.h"
#include "look/ticks.h"
#include "text.h"

namespace pelage {

namespace {

struct MeasureOptions {
  std::string shape, field, plot;
  std::optional<double> level;
  bool json = false;
};

Json to_json(const PatternPhase& phase) {
  return {{"parts", phase.parts}, {"share", json_number(phase.share)}, {"width", json_number(phase.width)}};
}

Json to_json(const Spots& spots) {
  Json neighbours = Json::object();
  for (const auto& [n, count] : spots.neighbours) neighbours[std::to_string(n)] = count;
  return {{"count", spots.count},
          {"diameter", json_number(spots.diameter)},
          {"nearest", json_number(spots.nearest)},
          {"neighbours", neighbours}};
}

const char* size_name(Ground ground) { return ground == Ground::volume ? "volume" : "area"; }

Json to_json(const Spectrum& s) {
  if (s.empty()) return nullptr;
  return {
      {"wavelength", json_number(wavelength_of(s.peak()))},
      {"half_between", {json_number(wavelength_of(s.quantile(0.75))), json_number(wavelength_of(s.quantile(0.25)))}},
      {"wave_number", s.wave_number},
      {"share", s.share}};
}

/// Without what nodes alone do not tell.
Json to_json(const PatternMeasures& m, const std::string& shape, const std::string& field, Ground ground) {
  Json json = {{"shape", shape},
               {"field", field},
               {size_name(ground), json_number(m.area)},
               {"minimum", json_number(m.minimum)},
               {"maximum", json_number(m.maximum)},
               {"mean", json_number(m.mean)},
               {"deviation", json_number(m.deviation)},
               {"level", json_number(m.level)},
               {"above", to_json(m.above)},
               {"below", to_json(m.below)},
               {"border", json_number(m.border)},
               {"wavelength", json_number(m.wavelength)},
               {"spacing", json_number(m.spacing)},
               {"coherence", json_number(m.coherence)},
               {"along", m.along},
               {"defects", {{"plus", m.defects.plus}, {"minus", m.defects.minus}}},
               {"spots", to_json(m.spots)},
               {"spectrum", to_json(m.spectrum)}};
  if (ground == Ground::surface) return json;
  for (const char* key : {"border", "coherence", "along", "defects"}) json.erase(key);
  for (const char* phase : {"above", "below"}) json[phase].erase("width");
  json["spots"].erase("neighbours");
  return json;
}

void print(const char* name, const PatternPhase& phase, Ground ground) {
  const std::string wide = ground == Ground::surface ? ", " + brief(phase.width) + " wide" : "";
  std::printf("%s%s %% of the %s in %s%s\n", name, brief(100 * phase.share).c_str(), size_name(ground),
              counted(phase.parts, "part").c_str(), wide.c_str());
}

/// "92, 60 with 6 neighbours, 20 with 5": the commonest first.
void print(const Spots& spots) {
  std::vector<std::pair<std::size_t, std::size_t>> kinds(spots.neighbours.begin(), spots.neighbours.end());
  std::ranges::stable_sort(kinds, std::greater{}, &std::pair<std::size_t, std::size_t>::second);
  std::string text;
  for (const auto& [n, count] : kinds)
    text += ", " + std::to_string(count) + " with " + std::to_string(n) + (text.empty() ? " neighbours" : "");
  std::printf("spots     %zu, %s across, the nearest %s apart%s\n", spots.count, brief(spots.diameter).c_str(),
              brief(spots.nearest).c_str(), text.c_str());
}

void print(const PatternMeasures& m, const std::string& field, std::size_t others, Ground ground) {
  const std::string more =
      others > 0 ? ", the first of " + counted(others + 1, "field") + "; --field names another" : "";
  std::printf("field     %s%s\n", field.c_str(), more.c_str());
  std::printf("values    %s to %s, mean %s, standard deviation %s\n", brief(m.minimum).c_str(),
              brief(m.maximum).c_str(), brief(m.mean).c_str(), brief(m.deviation).c_str());
  const std::string lines = ground == Ground::surface ? "; the lines there are " + brief(m.border) + " long" : "";
  std::printf("level     %s%s\n", brief(m.level).c_str(), lines.c_str());
  print("above     ", m.above, ground);
  print("below     ", m.below, ground);
  if (!(m.wavelength > 0)) {
    std::puts("pattern   none: the field is the same everywhere");
    return;
  }
  std::printf("pattern   wavelength %s, spacing of parts %s\n", brief(m.wavelength).c_str(), brief(m.spacing).c_str());
  std::printf("spectrum  wavelength %s at its peak, half of it from %s to %s\n",
              brief(wavelength_of(m.spectrum.peak())).c_str(), brief(wavelength_of(m.spectrum.quantile(0.75))).c_str(),
              brief(wavelength_of(m.spectrum.quantile(0.25))).c_str());
  print(m.spots);
  if (ground != Ground::surface) return;
  std::printf("stripes   %s of 1 (0: spots), along x %s, y %s, z %s\n", brief(m.coherence).c_str(),
              brief(m.along[0]).c_str(), brief(m.along[1]).c_str(), brief(m.along[2]).c_str());
  std::printf("defects   %zu of +1/2, %zu of -1/2 in the directions of stripes\n", m.defects.plus, m.defects.minus);
}

/// The density over the wave number, with its peak.
Plot spectrum_plot(const Spectrum& s, const std::string& title, const std::string& field) {
  constexpr int samples = 600;
  constexpr double room = 1.15, tail = 0.99;
  const double peak = s.peak(), largest = std::max(2.5 * peak, s.quantile(tail));
  std::vector<double> at;
  for (int i = 1; i <= samples; ++i) at.push_back(largest * i / samples);
  const std::vector<double> density = s.density(at);
  Plot plot;
  plot.title = title;
  plot.subtitle = "how the variance of " + field + " is shared out among wave numbers";
  plot.x_label = "wave number k [1 / unit of the file]";
  plot.y_label = "share per unit of ln k";
  plot.x = {0, largest};
  plot.y = {0, room * std::ranges::max(density)};
  PlotCurve curve{{}, parse_hex_color("#0b5f8a"), false, ""};
  for (std::size_t i = 0; i < at.size(); ++i) curve.points.push_back({at[i], density[i]});
  plot.curves = {curve};
  plot.marks = {{peak,
                 s.density({peak})[0],
                 parse_hex_color("#a3231f"),
                 {"peak: k = " + label_of(peak), "wavelength " + label_of(wavelength_of(peak))}}};
  return plot;
}

void run_measure(const MeasureOptions& options) {
  const ShapeFile file = read_shape(options.shape, {});
  const Ground ground = ground_of(file);
  if (!options.plot.empty()) check_picture_path(options.plot);
  const Attribute field = field_of(file.mesh, options.field, options.shape);
  const PatternMeasures measures = measure_coat(file, field, options.level);
  if (!options.plot.empty()) {
    if (measures.spectrum.empty())
      throw Error(Fault::input, "there is no spectrum to plot: the field is the same everywhere", {options.shape});
    write_png(draw(spectrum_plot(measures.spectrum, object_name(file, options.shape), field.name)), options.plot);
  }
  if (options.json) return print_json(to_json(measures, options.shape, field.name, ground));
  print(measures, field.name, field_names(file.mesh).size() - 1, ground);
}

}  // namespace

Command add_measure(CLI::App& parent) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* app = parent.add_subcommand(
      "measure",
      "Say in numbers what the pattern of a coat is like\n"
      "How many parts lie above and below a level, how much of the area they cover and how wide they are, the "
      "wavelength and the spectrum, spots with their neighbours, stripes with their directions and defects. Lengths "
      "are in units of the file.");
  app->add_option("SHAPE", options->shape,
                  "A coat with its species, as .vtp and .ply have them, also of clouds, and .vtu and .vti of volumes")
      ->required()
      ->type_name("");
  app->add_option("--field", options->field, "What to measure: a number at each vertex (default: the first)")
      ->type_name("NAME");
  app->add_option("--level", options->level,
                  "Where parts end (default: halfway between the lowest and the highest half percent of the values)")
      ->type_name("X");
  app->add_option("--plot", options->plot, "File for a picture of the spectrum: .png")->type_name("FILE");
  app->add_flag("--json", options->json, "Print the result as JSON");
  app->footer("Example:\n  pelage grow builtin:animal --model turing -o coat.vtp\n  pelage measure coat.vtp --field b");
  return {app, [options] { run_measure(*options); }};
}

}  // namespace pelage
