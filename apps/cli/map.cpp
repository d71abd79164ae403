// pelage map: what a model does over a grid of two of its parameters.

#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/parallel.h"
#include "base/suggest.h"
#include "catalog/models.h"
#include "command.h"
#include "interrupt.h"
#include "io/journal.h"
#include "io/output_set.h"
#include "io/png_writer.h"
#include "look/contact_sheet.h"
#include "look/dress.h"
#include "look/flat_tile.h"
#include "look/ramp.h"
#include "look/ticks.h"
#include "parts.h"
#include "pelage/io.h"
#include "progress_bar.h"
#include "recipe/setting.h"
#include "run/parameter_map.h"
#include "settings.h"
#include "text.h"
#include "usage.h"

namespace pelage {

namespace {

/// More cells would be smaller than a spot of their pattern.
constexpr int most_cells_across = 64;

struct MapOptions {
  std::string model, x, y, cells = "6x6", output = "map.png";
  std::vector<std::string> settings;
  std::optional<double> until, side;
  std::optional<std::string> species;
  std::string ramp = "science";
  std::uint64_t seed = 1;
  int threads = 0;
  bool json = false, quiet = false;
};

/// The number that is the whole text.
std::optional<double> whole_text(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

/// "PARAM=FROM:TO".
MapAxis parse_axis(const std::string& option, const std::string& text, int count) {
  const std::size_t equals = text.find('='), colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals != std::string::npos && equals > 0 && colon != std::string::npos) {
    const auto from = whole_text(std::string_view(text).substr(equals + 1, colon - equals - 1));
    const auto to = whole_text(std::string_view(text).substr(colon + 1));
    if (from && to && *from != *to) return {text.substr(0, equals), *from, *to, count};
  }
  throw Error(Fault::usage,
              option + " " + text + ": expected PARAM=FROM:TO with two different numbers, for example F=0.01:0.07");
}

/// "COLUMNSxROWS".
std::array<int, 2> parse_cells(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto columns = whole_text(std::string_view(text).substr(0, cross));
    const auto rows = whole_text(std::string_view(text).substr(cross + 1));
    const auto fits = [](double n) { return n >= 1 && n <= most_cells_across && n == std::floor(n); };
    if (columns && rows && fits(*columns) && fits(*rows)) return {static_cast<int>(*columns), static_cast<int>(*rows)};
  }
  throw Error(Fault::usage, "-n " + text + ": expected COLUMNSxROWS, each from 1 to " +
                                std::to_string(most_cells_across) + ", for example 6x6");
}

std::size_t shown_species(const ModelSource& model, const std::optional<std::string>& name) {
  std::vector<std::string> names;
  for (const SpeciesSource& s : model.species) names.push_back(s.name);
  if (!name) return names.size() - 1;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == *name) return i;
  throw Error(Fault::usage, unknown_name("species", *name, names));
}

MapRequest make_request(const MapOptions& options) {
  const auto [columns, rows] = parse_cells(options.cells);
  MapRequest request;
  request.x = parse_axis("--x", options.x, columns);
  request.y = parse_axis("--y", options.y, rows);
  if (request.x.parameter == request.y.parameter)
    throw Error(Fault::usage, "--x and --y both vary " + request.x.parameter + "; give two parameters");
  request.model = load_model(options.model);
  for (const std::string& text : options.settings) {
    const Stage::Setting setting = parse_setting(text, "--set");
    request.settings[setting.name] = setting.value;
  }
  request.side = options.side;
  request.until = options.until;
  request.species = shown_species(request.model, options.species);
  request.seed = options.seed;
  return request;
}

/// Every cell on its own scale of colours; without a pattern plain, with a word that says so.
SheetCell sheet_cell(const MapCell& cell, const Look& look, int tile) {
  if (cell.outcome == CellOutcome::uniform) return {{}, "uniform", false};
  if (cell.outcome == CellOutcome::failed) return {{}, "failed", true};
  return {flat_tile(dress(cell.fields, look), tile), "", false};
}

ContactSheet make_sheet(const MapOptions& options, const MapRequest& request, const ParameterMap& map) {
  Look look;
  look.species = {request.model.species[request.species].name, {}};
  look.ramp = {options.ramp, {}};
  look.flat = true;
  look.detail = 1;  // triangles of two or three pixels
  ContactSheet sheet;
  sheet.title = options.model;
  for (const std::string& text : options.settings) sheet.title += ", " + text;
  sheet.subtitle = look.species->value + " on flat squares of side " + brief(map.side) + ", each on its own scale";
  sheet.x_label = request.x.parameter;
  sheet.y_label = request.y.parameter;
  for (int i = 0; i < request.x.count; ++i) sheet.x.push_back(label_of(request.x.at(i)));
  for (int j = 0; j < request.y.count; ++j) sheet.y.push_back(label_of(request.y.at(j)));
  sheet.tile = sheet_tile(request.x.count, request.y.count);
  for (const MapCell& cell : map.cells) sheet.cells.push_back(sheet_cell(cell, look, sheet.tile));
  return sheet;
}

std::string outcome_name(CellOutcome outcome) {
  return outcome == CellOutcome::pattern ? "pattern" : outcome == CellOutcome::uniform ? "uniform" : "failed";
}

Json cell_json(const MapCell& cell, const MapRequest& request) {
  const Stability& s = cell.linear;
  Json json = {{"parameters", {{request.x.parameter, cell.x}, {request.y.parameter, cell.y}}},
               {"outcome", outcome_name(cell.outcome)},
               {"contrast", json_number(cell.contrast)},
               {"time", cell.summary.time},
               {"steps", cell.summary.steps},
               {"at_rest", cell.summary.status == RunStatus::stationary},
               {"linear_growth", json_number(s.growth)},
               {"linear_wavelength", s.band_min ? json_number(*s.wavelength) : Json(nullptr)}};
  if (cell.outcome == CellOutcome::failed) json["message"] = cell.summary.message;
  return json;
}

const MapCell* first_failed(const ParameterMap& map) {
  for (const MapCell& cell : map.cells)
    if (cell.outcome == CellOutcome::failed) return &cell;
  return nullptr;
}

/// "F = 0.04, k = 0.06".
std::string place_of(const MapCell& cell, const MapRequest& request) {
  return request.x.parameter + " = " + number(cell.x) + ", " + request.y.parameter + " = " + number(cell.y);
}

void report(const MapOptions& options, const MapRequest& request, const ParameterMap& map) {
  publish_outputs();
  if (options.json) {
    Json cells = Json::array();
    for (const MapCell& cell : map.cells) cells.push_back(cell_json(cell, request));
    print_json({{"model", options.model}, {"side", map.side}, {"cells", cells}, {"file", options.output}});
    return;
  }
  if (options.quiet) return;
  std::size_t count[3] = {};
  for (const MapCell& cell : map.cells) ++count[static_cast<int>(cell.outcome)];
  std::printf("cells     %zu: %zu with a pattern, %zu uniform, %zu failed\n", map.cells.size(), count[0], count[1],
              count[2]);
  if (const MapCell* failed = first_failed(map))
    std::printf("failed    %s\n", one_line(place_of(*failed, request) + ": " + failed->summary.message).c_str());
  std::printf("squares   of side %s in the model's length\n", number(map.side).c_str());
  std::printf("wrote     %s\n", options.output.c_str());
}

void map_command(const MapOptions& options) {
  check_picture_path(options.output);
  named_ramp(options.ramp);
  const MapRequest request = make_request(options);
  catch_interrupts();
  const ThreadLimit threads(options.threads);
  ProgressBar bar(options.quiet ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  Journal journal(options.output, record_for_files());
  const MapParts parts{[&](std::size_t c) { return journal.find(std::to_string(c)); },
                       [&](std::size_t c, const std::string& bytes) { journal.add(std::to_string(c), bytes); }};
  try {
    const ParameterMap map = run_map(request, bar.progress(), parts);
    bar.show("drawing " + options.output, 0);
    write_png(draw(make_sheet(options, request, map)), options.output);
    bar.clear();
    report(options, request, map);
    journal.finish();
  } catch (const Error& error) {
    if (error.fault() != Fault::cancelled) throw;
    throw Error(Fault::cancelled,
                "interrupted; no map was written" + where_to_go_on(journal, request.cell_count(), "cells"));
  }
}

void add_options(CLI::App& app, MapOptions& o) {
  app.add_option("MODEL", o.model, "A model, MODEL:VARIANT, or the path of a model's .toml file")
      ->type_name("")
      ->required();
  app.add_option("--x", o.x, "Parameter that varies from left to right")->type_name("PARAM=FROM:TO")->required();
  app.add_option("--y", o.y, "Parameter that varies from bottom to top")->type_name("PARAM=FROM:TO")->required();
  app.add_option("-n", o.cells, "Number of cells (default: 6x6)")->type_name("COLUMNSxROWS");
  add_settings_option(app, o.settings);
  app.add_option("--side", o.side, "Side of the squares, model length (default: five wavelengths)")
      ->type_name("LENGTH")
      ->check(positive_number());
  app.add_option("--until", o.until, "Stop at this model time (default: the model's suggestion)")
      ->type_name("T")
      ->check(positive_number());
  app.add_option("--seed", o.seed, "Number of the random start (default: 1)")
      ->type_name("N")
      ->check(whole_number(0, std::numeric_limits<std::int64_t>::max()));
  app.add_option("--species", o.species, "Which species is shown (default: the model's last)")->type_name("NAME");
  app.add_option("--ramp", o.ramp, "Colours (default: science): " + join_names(ramp_names()))->type_name("NAME");
  app.add_option("-o,--output", o.output, "File for the map: .png (default: map.png)")->type_name("FILE");
  app.add_option("--threads", o.threads, "Threads to use (default: all cores); the result does not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  app.add_flag("--json", o.json, "Print what came of every cell as JSON");
  app.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

}  // namespace

Command add_map(CLI::App& parent) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* app = parent.add_subcommand(
      "map",
      "Draw what a model does over two of its parameters\n"
      "Every cell of the map is a small run on a flat square without flux through its sides. Cells that stay "
      "uniform or fail are marked as such.");
  add_options(*app, *options);
  app->footer(
      "Examples:\n"
      "  pelage map gray-scott --x F=0.01:0.07 --y k=0.045:0.07 -n 8x8 -o pearson.png\n"
      "  pelage map schnakenberg --x d=5:40 --y a=0.02:0.3 --json");
  return {app, [options] { map_command(*options); }};
}

}  // namespace pelage
