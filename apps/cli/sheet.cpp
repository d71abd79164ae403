// pelage sheet: coats side by side, in rows and columns of whatever differs.

#include <cstdio>
#include <memory>

#include "base/job_progress.h"
#include "base/parallel.h"
#include "catalog/plan.h"
#include "command.h"
#include "gallery_subjects.h"
#include "grow_options.h"
#include "input_unit.h"
#include "interrupt.h"
#include "io/output_set.h"
#include "io/png_writer.h"
#include "look/contact_sheet.h"
#include "parts.h"
#include "pelage/render.h"
#include "progress_bar.h"
#include "text.h"
#include "tile_picture.h"
#include "usage.h"

namespace pelage {

namespace {

constexpr int smallest_tile = 40, largest_tile = 2048;

struct SheetOptions {
  std::vector<std::string> recipes, models, shapes, seeds, settings;
  std::optional<std::string> size, quality;
  std::optional<double> input_unit;
  std::string output = "sheet.png";
  std::optional<int> tile;
  int threads = 0;
  ViewOptions view;
  bool json = false, quiet = false;
};

/// Something that differs, or the single value of it.
struct Axis {
  std::string name;                 ///< as people read it
  std::string option;               ///< by which it was given
  std::vector<std::string> values;  ///< as labels show them
  std::function<void(GrowOptions&, std::size_t)> set;
};

/// "a=1,2,3".
Axis setting_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw Error(Fault::usage, "--set " + text + ": expected PARAM=VALUE,VALUE, for example F=0.03,0.04,0.05");
  Axis axis{
      text.substr(0, equals), "--set " + text.substr(0, equals), CLI::detail::split(text.substr(equals + 1), ','), {}};
  axis.set = [name = axis.name, values = axis.values](GrowOptions& o, std::size_t i) {
    o.settings.push_back(name + "=" + values[i]);
  };
  return axis;
}

/// Recipes, and models behind them.
Axis subject_axis(const SheetOptions& options) {
  const std::size_t recipes = options.recipes.size();
  Axis axis{options.models.empty() ? "recipe"
            : recipes == 0         ? "model"
                                   : "recipe or model",
            options.models.empty() ? "--recipes" : "--models",
            options.recipes,
            {}};
  axis.values.insert(axis.values.end(), options.models.begin(), options.models.end());
  axis.set = [recipes, names = axis.values](GrowOptions& o, std::size_t i) {
    (i < recipes ? o.recipe : o.model) = names[i];
  };
  return axis;
}

std::vector<std::string> names_of(const std::vector<GalleryShape>& shapes) {
  std::vector<std::string> names;
  for (const GalleryShape& shape : shapes) names.push_back(shape.name);
  return names;
}

Axis seed_axis(const SheetOptions& options) {
  return {"seed", "--seeds", options.seeds,
          [seeds = options.seeds](GrowOptions& o, std::size_t i) { o.seed = std::stoull(seeds[i]); }};
}

/// Of all lists, shapes aside.
std::vector<Axis> axes_of(const SheetOptions& options, const std::vector<GalleryShape>& shapes) {
  std::vector<Axis> axes;
  if (!options.recipes.empty() || !options.models.empty()) axes.push_back(subject_axis(options));
  axes.push_back({"shape", "--shapes", names_of(shapes),
                  [paths = options.shapes](GrowOptions& o, std::size_t i) { o.shape = paths[i]; }});
  for (const std::string& text : options.settings) axes.push_back(setting_axis(text));
  if (!options.seeds.empty()) axes.push_back(seed_axis(options));
  return axes;
}

/// What runs along the columns and the rows: the lists with several values, the longer one across.
std::array<const Axis*, 2> columns_and_rows(const std::vector<Axis>& axes) {
  std::array<const Axis*, 2> both{};
  std::string names;
  std::size_t count = 0;
  for (const Axis& axis : axes) {
    if (axis.values.size() < 2) continue;
    if (count < 2) both[count] = &axis;
    names += (count == 0 ? "" : ", ") + axis.option + " (" + std::to_string(axis.values.size()) + ")";
    ++count;
  }
  if (count > 2)
    throw Error(Fault::usage, "a sheet has rows and columns, and " + names +
                                  " have several values; leave one value to all but two, and make several sheets");
  if (both[0] && both[1] && both[1]->values.size() > both[0]->values.size()) std::swap(both[0], both[1]);
  return both;
}

struct Tile {
  std::string name;
  Recipe recipe;
  const GalleryShape* shape = nullptr;
  TilePicture picture;
  std::string failure;
};

std::size_t length_of(const Axis* axis) { return axis ? axis->values.size() : 1; }

/// Row by row from the top; every recipe is known to make sense.
std::vector<Tile> tiles_of(const SheetOptions& options, const std::vector<Axis>& axes,
                           const std::array<const Axis*, 2>& both, const std::vector<GalleryShape>& shapes) {
  std::vector<Tile> tiles;
  for (std::size_t j = 0; j < length_of(both[1]); ++j)
    for (std::size_t i = 0; i < length_of(both[0]); ++i) {
      GrowOptions grow;
      grow.size = options.size;
      grow.quality = options.quality;
      Tile tile;
      for (const Axis& axis : axes) {
        const std::size_t k = &axis == both[0] ? i : &axis == both[1] ? j : 0;
        axis.set(grow, k);
        if (axis.name == "shape") tile.shape = &shapes[k];
        tile.name +=
            (tile.name.empty() ? "" : ", ") +
            (axis.name == "shape" || axis.option == "--recipes" ? axis.values[k] : axis.name + " " + axis.values[k]);
      }
      tile.recipe = make_recipe(grow);
      plan(tile.recipe);
      tiles.push_back(std::move(tile));
    }
  return tiles;
}

std::vector<const Recipe*> recipes_of(const std::vector<Tile>& tiles) {
  std::vector<const Recipe*> recipes;
  for (const Tile& tile : tiles) recipes.push_back(&tile.recipe);
  return recipes;
}

/// `number`: what the journal calls it.
void make_tile(Tile& tile, const std::string& number, const SheetOptions& options, int size, Journal& journal,
               const std::function<bool(double)>& report) {
  try {
    if (const auto before = journal.find(number))
      if (auto picture = tile_of(*before)) {
        tile.picture = std::move(*picture);
        return;
      }
    tile.picture = tile_picture(tile.recipe, tile.shape->file, options.view, size, report);
    if (!tile.picture.image.rgb.empty()) journal.add(number, bytes_of(tile.picture));
  } catch (const Error& error) {
    if (error.fault() == Fault::output) throw;
    if (error.fault() != Fault::cancelled) tile.failure = one_line(error.what());
  }
}

/// False when it was interrupted.
bool make_tiles(std::vector<Tile>& tiles, const SheetOptions& options, int size, Journal& journal,
                const Progress& progress) {
  JobProgress job_progress(progress, "growing the tiles", tiles.size());
  parallel_chunks(tiles.size(), [&](std::size_t t) {
    const auto report = [&](double fraction) { return job_progress.report(t, fraction); };
    if (!report(0)) return;
    run_on_one_thread([&] { make_tile(tiles[t], std::to_string(t), options, size, journal, report); });
    report(1);
  });
  return !job_progress.cancelled();
}

/// In the middle of a square tile; grids have other proportions.
Image squared(const Image& picture, int size, const std::array<double, 3>& paper) {
  if (picture.width == size && picture.height == size) return picture;
  Image square{size, size, {}};
  for (int i = 0; i < size * size; ++i)
    for (const double c : paper) square.rgb.push_back(static_cast<float>(c));
  const int width = std::min(size, picture.width), height = std::min(size, picture.height);
  for (int y = 0; y < height; ++y)
    std::copy_n(
        picture.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(picture.width) * y, 3 * width,
        square.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(size) * (y + (size - height) / 2) + (size - width) / 2));
  return square;
}

SheetCell cell_of(const Tile& tile, int size) {
  if (!tile.failure.empty()) return {{}, "failed", true};
  return {squared(tile.picture.image, size, {1, 1, 1}), "", false};
}

/// "leopard, seed 1": what all tiles have in common.
std::string title_of(const std::vector<Axis>& axes) {
  std::string title;
  for (const Axis& axis : axes)
    if (axis.values.size() == 1)
      title += (title.empty() ? "" : ", ") +
               (axis.name == "recipe" || axis.name == "model" || axis.name == "shape" ? "" : axis.name + " ") +
               axis.values[0];
  return title;
}

ContactSheet sheet_of(const std::vector<Tile>& tiles, const std::vector<Axis>& axes,
                      const std::array<const Axis*, 2>& both, int size) {
  ContactSheet sheet;
  sheet.title = title_of(axes);
  sheet.tile = size;
  const std::size_t columns = length_of(both[0]), rows = length_of(both[1]);
  sheet.x = both[0] ? both[0]->values : std::vector<std::string>{""};
  sheet.y = both[1] ? both[1]->values : std::vector<std::string>{""};
  std::ranges::reverse(sheet.y);  // the first row is the lowest
  if (both[0]) sheet.x_label = both[0]->name;
  if (both[1]) sheet.y_label = both[1]->name;
  for (std::size_t j = rows; j-- > 0;)
    for (std::size_t i = 0; i < columns; ++i) sheet.cells.push_back(cell_of(tiles[columns * j + i], size));
  return sheet;
}

void warn(const std::string& text) { std::fprintf(stderr, "pelage: warning: %s\n", one_line(text).c_str()); }

std::size_t warn_of_tiles(const std::vector<Tile>& tiles) {
  std::size_t failed = 0;
  for (const Tile& tile : tiles) {
    if (!tile.picture.uniform.empty()) warn(tile.name + " is uniform, " + tile.picture.uniform);
    if (tile.failure.empty()) continue;
    warn(tile.name + " failed: " + tile.failure);
    ++failed;
  }
  return failed;
}

Json to_json(const std::vector<Tile>& tiles, const std::string& file) {
  Json list = Json::array();
  for (const Tile& tile : tiles)
    list.push_back({{"name", tile.name},
                    {"uniform", !tile.picture.uniform.empty()},
                    {"failure", tile.failure.empty() ? Json(nullptr) : Json(tile.failure)}});
  return {{"file", file}, {"tiles", list}};
}

int tile_size(const SheetOptions& options, const std::array<const Axis*, 2>& both) {
  constexpr int page = 1600, most = 480;
  const auto longer = static_cast<int>(std::max(length_of(both[0]), length_of(both[1])));
  return options.tile.value_or(std::clamp(page / longer, smallest_tile, most));
}

void sheet(const SheetOptions& options) {
  check_picture_path(options.output);
  catch_interrupts();
  const std::vector<GalleryShape> shapes = gallery_shapes(options.shapes, true, options.input_unit);
  const std::vector<Axis> axes = axes_of(options, shapes);
  const std::array<const Axis*, 2> both = columns_and_rows(axes);
  const int size = tile_size(options, both);
  check_picture_size(size * static_cast<int>(length_of(both[0])), size * static_cast<int>(length_of(both[1])),
                     options.output);
  std::vector<Tile> tiles = tiles_of(options, axes, both, shapes);
  const ThreadLimit threads(options.threads);
  ProgressBar bar(options.quiet ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  Journal journal(options.output, record_with_images(recipes_of(tiles)));
  if (!make_tiles(tiles, options, size, journal, bar.progress()))
    throw Error(Fault::cancelled, "interrupted; no sheet was written" + where_to_go_on(journal, tiles.size(), "tiles"));
  write_png(draw(sheet_of(tiles, axes, both, size)), options.output);
  publish_outputs();
  journal.finish();
  bar.clear();
  const std::size_t failed = warn_of_tiles(tiles);
  if (options.json) print_json(to_json(tiles, options.output));
  if (failed > 0)
    throw Error(Fault::numerics, std::to_string(failed) + " of " + counted(tiles.size(), "tile") + " failed; " +
                                     options.output + " shows the others");
  if (!options.quiet && !options.json)
    std::printf("wrote     %s with %s\n", options.output.c_str(), counted(tiles.size(), "tile").c_str());
}

CLI::Option* add_list(CLI::App& app, const char* name, std::vector<std::string>& list, const std::string& help,
                      const char* type) {
  return app.add_option(name, list, help)->type_name(type)->delimiter(',')->allow_extra_args(false);
}

void add_options(CLI::App& app, SheetOptions& o) {
  add_list(app, "--recipes", o.recipes, "Built-in recipes or .toml files", "NAME[,NAME]");
  add_list(app, "--models", o.models, "Models, MODEL:VARIANT, or .toml files (without recipes too: turing)",
           "NAME[,NAME]");
  add_list(app, "--shapes", o.shapes, "What they grow on: files or builtin:NAME", "SHAPE[,SHAPE]")->required();
  add_list(app, "--seeds", o.seeds, "Numbers of the random patterns", "N[,N]")
      ->check(whole_number(0, std::numeric_limits<std::int64_t>::max()));
  app.add_option("--set", o.settings,
                 "Values of a parameter, or of size, as in grow; for another parameter it is given again")
      ->type_name("[STAGE.]PARAM=VALUE[,VALUE]")
      ->allow_extra_args(false);
  app.add_option("--size", o.size, "Spacing of all patterns, as in grow")->type_name("LENGTH");
  app.add_option("--quality", o.quality, "Of all of them, as in grow")->type_name("NAME");
  add_input_unit_option(app, o.input_unit);
  app.add_option("-o,--output", o.output, "File for the sheet: .png (default: sheet.png)")->type_name("FILE");
  app.add_option("--picture-size", o.tile, "Width and height of a tile, pixels (default: for a page)")
      ->type_name("N")
      ->check(whole_number(smallest_tile, largest_tile));
  add_view_options(app, o.view);
  app.add_option("--threads", o.threads, "Threads to use (default: all cores); the result does not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  app.add_flag("--json", o.json, "Print the list of tiles as JSON");
  app.add_flag("-q,--quiet", o.quiet, "Print warnings and errors only");
}

}  // namespace

Command add_sheet(CLI::App& parent) {
  auto options = std::make_shared<SheetOptions>();
  CLI::App* app = parent.add_subcommand(
      "sheet",
      "Draw coats side by side: recipes, models, shapes, seeds, values of parameters\n"
      "The two lists that have several values are the columns (the longer one) and rows of the sheet. A tile that "
      "fails is crossed out, and the exit code says so.");
  add_options(*app, *options);
  app->footer(
      "Examples:\n"
      "  pelage sheet --recipes leopard,zebra,giraffe --shapes cow.obj,builtin:torus -o coats.png\n"
      "  pelage sheet --shapes builtin:animal --seeds 1,2,3,4 --recipes cheetah\n"
      "  pelage sheet --models gray-scott --shapes builtin:sphere --set F=0.03,0.04,0.05 --set k=0.06,0.062");
  return {app, [options] { sheet(*options); }};
}

}  // namespace pelage
