#include "run_command.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "base/memory.h"
#include "command.h"
#include "help_format.h"
#include "invocation.h"
#include "pelage/error.h"
#include "recorded_words.h"
#include "usage.h"

namespace pelage {

namespace {

constexpr const char* examples = R"(Examples:
  pelage grow cow.obj --model turing --size 0.04 -o cow.glb --picture cow.png
  pelage grow builtin:animal --ramp leopard -o cub.glb
  pelage check cow.obj
  pelage models turing
  pelage analyse turing --set Da=0.15 --plot growth.png
  pelage help grow

Exit codes: 0 done; 1 pelage again: another result; 2 wrong usage, unknown name or
parameter; 3 an input that cannot be read or used; 4 the computation failed; 5 an output
cannot be written; 130 interrupted.)";

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

/// What needs more is refused beforehand where that is foreseen, and else fails as on a machine that has no more.
void take_at_most(double bytes) {
  if (!(bytes > 0)) return;
  limit_memory(bytes);
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(bytes));
  setrlimit(RLIMIT_DATA, &limit);
}

/// All commands, with what those have in common that write.
class CommandLine {
 public:
  CommandLine() {
    app_.set_version_flag("--version", "pelage " PELAGE_VERSION, "Print the version and exit");
    app_.formatter(std::make_shared<HelpFormat>());  // which commands take over when they are added
    app_.footer(examples);
    commands_ = all_commands(app_);
    for (const Command& command : commands_) {
      if (command.app->get_option_no_throw("--output")) {
        command.app->add_flag("--force", force_, "Let an output take the place of a file that is read");
        add_max_memory(*command.app, max_memory_);
      }
      if (can_be_repeated(command.app->get_name()) || command.app->get_name() == "gallery")
        command.app->add_flag("--no-record", no_record_,
                              "Leave out of the files what made them, which pelage explain and again read");
    }
  }

  const Command& parse(const std::vector<std::string>& words) { return parse_arguments(app_, commands_, words); }
  CLI::App& app() { return app_; }
  bool force() const { return force_; }
  bool no_record() const { return no_record_; }
  double max_memory() const { return max_memory_; }

 private:
  static std::vector<Command> all_commands(CLI::App& app) {
    return {add_grow(app),     add_resume(app),  add_again(app),   add_explain(app), add_check(app), add_models(app),
            add_formulas(app), add_analyse(app), add_map(app),     add_gallery(app), add_sheet(app), add_recipes(app),
            add_fair(app),     add_field(app),   add_compare(app), add_grid(app),    add_cells(app), add_measure(app),
            add_unwrap(app),   add_render(app),  add_verify(app)};
  }

  CLI::App app_{"Grows reaction-diffusion coats directly on surfaces.", "pelage"};
  std::vector<Command> commands_;
  bool force_ = false, no_record_ = false;
  double max_memory_ = 0;
};

Record record_of(const Command& command) {
  return {PELAGE_VERSION, std::string(own_architecture()), recorded_words(*command.app), {}, {}, {}};
}

/// Words of a record as this program would write them: with no option that a record has not, and no name of an output.
void require_recorded(const std::vector<std::string>& words) {
  if (words.empty() || !can_be_repeated(words[0]))
    throw Error(Fault::usage, "pelage again repeats what writes files by names of options, and " +
                                  (words.empty() ? "the record holds no command" : "\"" + words[0] + "\" does not"));
  try {
    CommandLine line;
    std::vector<std::string> again = recorded_words(*line.parse(words).app);
    if (std::ranges::is_permutation(again, words)) return;
  } catch (const CLI::Success&) {
  }
  throw Error(Fault::usage, "the command in the record is not as this program writes it; nothing was run");
}

}  // namespace

int run_command(std::vector<std::string> words) {
  CommandLine line;
  if (words.empty()) {
    std::fputs(line.app().help().c_str(), stderr);
    return static_cast<int>(Fault::usage);
  }
  const Command* used = nullptr;
  try {
    used = &line.parse(words);
  } catch (const CLI::Success& success) {
    return line.app().exit(success);
  }
  if (used->stands_for) return run_command(used->stands_for());
  set_invocation({std::move(words), std::filesystem::current_path().string()});
  take_at_most(line.max_memory());
  OutputSetOptions options{line.force(), {}, {}};
  if (!line.no_record()) options.record = record_of(*used);
  OutputSet outputs(std::move(options));
  used->run();
  outputs.publish();
  return used->exit_code ? used->exit_code() : 0;
}

void repeat_command(const Repetition& repetition) {
  require_recorded(repetition.words);
  CommandLine line;
  std::vector<std::string> words = words_to_repeat(repetition.words, repetition.folder, repetition.file);
  if (line.app().get_subcommand(words[0])->get_option_no_throw("--quiet")) words.push_back("--quiet");
  const Command& command = line.parse(words);
  Record record = record_of(command);
  record.version = repetition.version;
  record.architecture = repetition.architecture;
  OutputSet outputs({false, repetition.confinement, std::move(record)});
  command.run();
  outputs.publish();
}

}  // namespace pelage
