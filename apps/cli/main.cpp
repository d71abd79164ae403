// The command line: options to library calls, faults to exit codes.

#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

#include "command.h"
#include "help_format.h"
#include "interrupt.h"
#include "pelage/error.h"
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

/// Whether errors are wanted as JSON, too; asked before the arguments are known to be right.
bool wants_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--json") == 0) return true;
  return false;
}

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

int run(int argc, char** argv, CLI::App& app, const std::vector<pelage::Command>& commands) {
  const bool json = wants_json(argc, argv);
  try {
    pelage::parse_arguments(app, commands, argc, argv).run();
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const Error& error) {
    return report(error.what(), exit_code_of(error.fault()), json);
  } catch (const std::bad_alloc&) {
    return report("out of memory; take a coarser mesh, a larger --size, a smaller --detail or fewer texels",
                  static_cast<int>(Fault::input), json);
  } catch (const std::exception& error) {
    return report(std::string("unexpected failure: ") + error.what() + "; please report it",
                  static_cast<int>(Fault::numerics), json);
  }
  if (std::fflush(stdout) != 0) return report("cannot write to the standard output", 5, false);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Grows reaction-diffusion coats directly on surfaces.", "pelage");
  app.set_version_flag("--version", "pelage " PELAGE_VERSION, "Print the version and exit");
  app.formatter(std::make_shared<pelage::HelpFormat>());
  app.footer(examples);
  const std::vector<pelage::Command> commands = {
      pelage::add_grow(app),    pelage::add_check(app), pelage::add_models(app),  pelage::add_formulas(app),
      pelage::add_analyse(app), pelage::add_map(app),   pelage::add_gallery(app), pelage::add_sheet(app),
      pelage::add_recipes(app), pelage::add_fair(app),  pelage::add_field(app),   pelage::add_compare(app),
      pelage::add_grid(app),    pelage::add_cells(app), pelage::add_measure(app), pelage::add_unwrap(app),
      pelage::add_render(app),  pelage::add_verify(app)};
  if (argc == 1) {
    std::fputs(app.help().c_str(), stderr);
    return static_cast<int>(Fault::usage);
  }
  return run(argc, argv, app, commands);
}
