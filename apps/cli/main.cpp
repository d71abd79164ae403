// The command line: options to library calls, faults to exit codes.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "commands.h"
#include "help_format.h"
#include "interrupt.h"
#include "invocation.h"
#include "io/output_set.h"
#include "pelage/error.h"
#include "pelage/named_files.h"
#include "text.h"
#include "usage.h"

namespace {

using pelage::Error;
using pelage::Fault;

constexpr const char* examples = R"(Examples:
  pelage grow cow.obj --model turing --size 0.04 -o cow.glb --picture cow.png
  pelage grow builtin:animal --ramp leopard -o cub.glb
  pelage check cow.obj
  pelage models turing
  pelage analyse turing --set Da=0.15 --plot growth.png
  pelage help grow

Exit codes: 0 done; 2 wrong usage, unknown name or parameter; 3 an input that cannot be
read or used; 4 the computation failed; 5 an output cannot be written; 130 interrupted.)";

int report(const std::string& message, int exit_code, bool json) {
  const std::string line = pelage::one_line(message);
  std::fprintf(stderr, "pelage: error: %s\n", line.c_str());
  if (json) pelage::print_json({{"error", line}, {"exit", exit_code}});
  return exit_code;
}

int exit_code_of(Fault fault) {
  const int signal = pelage::interrupt_signal();
  return fault == Fault::cancelled && signal ? 128 + signal : static_cast<int>(fault);
}

/// Its outputs appear together at its end, or not at all. Returns the exit code.
int run_command(std::vector<std::string> words) {
  CLI::App app("Grows reaction-diffusion coats directly on surfaces.", "pelage");
  app.set_version_flag("--version", "pelage " PELAGE_VERSION, "Print the version and exit");
  app.formatter(std::make_shared<pelage::HelpFormat>());
  app.footer(examples);
  pelage::CommonOptions common;
  const std::vector<pelage::Command> commands = add_commands(app, common);
  if (words.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return static_cast<int>(Fault::usage);
  }
  const pelage::Command* used = nullptr;
  try {
    used = &pelage::parse_arguments(app, commands, words);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  }
  const pelage::Command& command = *used;
  if (command.stands_for) return run_command(command.stands_for());
  pelage::set_invocation({std::move(words), std::filesystem::current_path().string()});
  pelage::allow_outside_files(common.outside);
  pelage::OutputSet outputs(common.force);
  command.run();
  outputs.publish();
  return 0;
}

int run(const std::vector<std::string>& words) {
  const bool json = std::ranges::count(words, "--json") > 0;
  int exit_code = 0;
  try {
    exit_code = run_command(words);
  } catch (const Error& error) {
    return report(error.what(), exit_code_of(error.fault()), json);
  } catch (const std::bad_alloc&) {
    return report("out of memory; take a coarser mesh, a larger --size or a smaller --detail or fewer texels",
                  static_cast<int>(Fault::numerics), json);
  } catch (const std::exception& error) {
    return report(std::string("unexpected failure: ") + error.what() + "; please report it",
                  static_cast<int>(Fault::numerics), json);
  }
  if (std::fflush(stdout) != 0) return report("cannot write to the standard output", 5, false);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of its writer
  return run(std::vector<std::string>(argv + 1, argv + argc));
}
