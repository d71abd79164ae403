#include "commands.h"

namespace pelage {

namespace {

/// For every command that writes.
void add_force(const std::vector<Command>& commands, bool& force) {
  for (const Command& command : commands)
    if (command.app->get_option_no_throw("--output"))
      command.app->add_flag("--force", force, "Let an output take the place of a file that is read");
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
  std::vector<Command> commands = {add_grow(app),     add_resume(app),  add_check(app), add_models(app),
                                   add_formulas(app), add_analyse(app), add_map(app),   add_gallery(app),
                                   add_sheet(app),    add_recipes(app), add_fair(app),  add_field(app),
                                   add_compare(app),  add_grid(app),    add_cells(app), add_measure(app),
                                   add_unwrap(app),   add_render(app),  add_verify(app)};
  add_force(commands, common.force);
  add_allow_outside(app, common.outside);
  return commands;
}

}  // namespace pelage
