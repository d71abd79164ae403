#include "commands.h"

#include <map>

#include "recorded_words.h"

namespace pelage {

namespace {

/// Less does not do for anything: the program itself and its threads.
constexpr double smallest_memory = 1e8;

void add_max_memory(CLI::App& command, double& bytes) {
  const std::map<std::string, double> units = {
      {"B", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"GiB", 1024 * 1024 * 1024}, {"TB", 1e12}};
  command
      .add_option("--max-memory", bytes,
                  "Take no more memory than this, such as 4GB (default: what the machine has left)")
      ->type_name("SIZE")
      ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_INSENSITIVE, "SIZE"))
      ->check(CLI::Range(smallest_memory, 1e18));
}

/// For every command that writes.
void add_output_options(const std::vector<Command>& commands, CommonOptions& common) {
  for (const Command& command : commands) {
    const std::string name = command.app->get_name();
    if (command.app->get_option_no_throw("--output")) {
      command.app->add_flag("--force", common.force, "Let an output take the place of a file that is read");
      add_max_memory(*command.app, common.max_memory);
    }
    if (can_be_repeated(name) || name == "gallery" || name == "figures")
      command.app->add_flag("--no-record", common.no_record,
                            "Leave out of the files what made them, which pelage explain and again read");
  }
}

/// For every command that reads files that name others. (Models name none, and "resume" has the words of its growth.)
void add_allow_outside(CLI::App& app, bool& allowed) {
  for (const char* name : {"grow", "check", "gallery", "sheet", "fair", "field", "compare", "grid", "cells", "measure",
                           "unwrap", "render"})
    app.get_subcommand(name)->add_flag("--allow-outside", allowed,
                                       "Let files name others outside their own folder: images, buffers, materials");
}

}  // namespace

std::vector<Command> add_commands(CLI::App& app, CommonOptions& common) {
  std::vector<Command> commands = {
      add_grow(app),     add_resume(app),  add_again(app),  add_explain(app), add_check(app), add_models(app),
      add_formulas(app), add_analyse(app), add_map(app),    add_gallery(app), add_sheet(app), add_figures(app),
      add_recipes(app),  add_fair(app),    add_field(app),  add_compare(app), add_grid(app),  add_cells(app),
      add_measure(app),  add_unwrap(app),  add_render(app), add_studio(app),  add_verify(app)};
  add_output_options(commands, common);
  add_allow_outside(app, common.outside);
  return commands;
}

}  // namespace pelage
