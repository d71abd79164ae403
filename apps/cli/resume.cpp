// pelage resume: a growth that was cut off goes on.

#include <memory>

#include "checkpoint_file.h"
#include "command.h"

namespace pelage {

Command add_resume(CLI::App& parent) {
  auto file = std::make_shared<std::string>();
  CLI::App* app = parent.add_subcommand(
      "resume",
      "Go on with a growth that was cut off\n"
      "The checkpoint knows the command that wrote it, and the folder it was given in; shape, images and recipe must "
      "still be there and be the same. The outputs are those of the unbroken run, to the bit.");
  app->add_option("FILE", *file, "A checkpoint, written by --checkpoint or by itself where a growth takes long")
      ->type_name("")
      ->required();
  app->footer(
      "Examples:\n  pelage grow cow.obj --recipe leopard --checkpoint cow.state -o cow.glb\n"
      "  pelage resume cow.state");
  Command command{app, {}};
  command.stands_for = [file] { return words_to_resume(*file); };
  return command;
}

}  // namespace pelage
