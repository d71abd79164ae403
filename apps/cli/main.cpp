// The command line: options to library calls, faults to exit codes.

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "base/memory.h"
#include "command.h"
#include "help_format.h"
#include "interrupt.h"
#include "invocation.h"
#include "io/output_set.h"
#include "pelage/error.h"
#include "text.h"
#include "usage.h"

namespace {

using pelage::Error;
using pelage::Fault;

/// Less does not do for anything: the program itself and its threads.
constexpr double smallest_memory = 1e8;

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

std::vector<pelage::Command> all_commands(CLI::App& app) {
  return {pelage::add_grow(app),     pelage::add_resume(app),  pelage::add_check(app), pelage::add_models(app),
          pelage::add_formulas(app), pelage::add_analyse(app), pelage::add_map(app),   pelage::add_gallery(app),
          pelage::add_sheet(app),    pelage::add_recipes(app), pelage::add_fair(app),  pelage::add_field(app),
          pelage::add_compare(app),  pelage::add_grid(app),    pelage::add_cells(app), pelage::add_measure(app),
          pelage::add_unwrap(app),   pelage::add_render(app),  pelage::add_verify(app)};
}

/// For every command that writes.
void add_force(const std::vector<pelage::Command>& commands, bool& force) {
  for (const pelage::Command& command : commands)
    if (command.app->get_option_no_throw("--output"))
      command.app->add_flag("--force", force, "Let an output take the place of a file that is read");
}

/// For the same commands: the work of others is small.
void add_max_memory(const std::vector<pelage::Command>& commands, double& bytes) {
  const std::map<std::string, double> units = {
      {"B", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"GiB", 1024 * 1024 * 1024}, {"TB", 1e12}};
  for (const pelage::Command& command : commands)
    if (command.app->get_option_no_throw("--output"))
      command.app
          ->add_option("--max-memory", bytes,
                       "Take no more memory than this, such as 4GB (default: what the machine has left)")
          ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_INSENSITIVE, "SIZE"))
          ->check(CLI::Range(smallest_memory, 1e18));
}

/// What needs more is refused beforehand where that is foreseen, and else fails as on a machine that has no more.
void take_at_most(double bytes) {
  pelage::limit_memory(bytes);
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(bytes));
  setrlimit(RLIMIT_DATA, &limit);
}

std::string out_of_memory() {
  std::string limit;
  pelage::memory_left(&limit);
  const double most = pelage::memory_used_at_most();
  return "out of memory" + (most > 0 ? " at " + pelage::bytes_in_words(most) : "") +
         (limit.empty() ? "" : ": " + limit) +
         "; take a coarser mesh, a larger --size or a smaller --detail or fewer texels";
}

/// Its outputs appear together at its end, or not at all. Returns the exit code.
int run_command(std::vector<std::string> words) {
  CLI::App app("Grows reaction-diffusion coats directly on surfaces.", "pelage");
  app.set_version_flag("--version", "pelage " PELAGE_VERSION, "Print the version and exit");
  app.formatter(std::make_shared<pelage::HelpFormat>());
  app.footer(examples);
  const std::vector<pelage::Command> commands = all_commands(app);
  bool force = false;
  double max_memory = 0;
  add_force(commands, force);
  add_max_memory(commands, max_memory);
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
  if (max_memory > 0) take_at_most(max_memory);
  pelage::OutputSet outputs(force);
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
    return report(out_of_memory(), static_cast<int>(Fault::numerics), json);
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
