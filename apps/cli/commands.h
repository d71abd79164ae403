#pragma once
// All commands of the program.

#include <vector>

#include "command.h"

namespace pelage {

/// Options that many commands have alike.
struct CommonOptions {
  bool force = false;      ///< outputs may take the place of files that are read
  bool outside = false;    ///< files may name others outside their own folder
  bool no_record = false;  ///< files do not say what made them
  double max_memory = 0;   ///< of the whole process [bytes]; 0: what the machine has
};

/// The commands with all their options.
std::vector<Command> add_commands(CLI::App& app, CommonOptions& common);

}  // namespace pelage
