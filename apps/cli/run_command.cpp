#include "run_command.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/memory.h"
#include "commands.h"
#include "help_format.h"
#include "invocation.h"
#include "pelage/error.h"
#include "pelage/named_files.h"
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

/// What needs more is refused beforehand where that is foreseen, and else fails as on a machine that has no more.
void take_at_most(double bytes) {
  if (!(bytes > 0)) return;
  limit_memory(bytes);
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(bytes));
  setrlimit(RLIMIT_DATA, &limit);
}

/// All commands, and the options that are read with them.
class CommandLine {
 public:
  CommandLine() {
    app_.set_version_flag("--version", "pelage " PELAGE_VERSION, "Print the version and exit");
    app_.formatter(std::make_shared<HelpFormat>());  // which commands take over when they are added
    app_.footer(examples);
    commands_ = add_commands(app_, common_);
  }

  const Command& parse(const std::vector<std::string>& words) { return parse_arguments(app_, commands_, words); }
  CLI::App& app() { return app_; }
  /// The same words without a word on stdout, where the command knows how.
  std::vector<std::string> quiet(std::vector<std::string> words) {
    if (app_.get_subcommand(words[0])->get_option_no_throw("--quiet")) words.push_back("--quiet");
    return words;
  }
  const CommonOptions& common() const { return common_; }

 private:
  CLI::App app_{"Grows reaction-diffusion coats directly on surfaces.", "pelage"};
  CommonOptions common_;
  std::vector<Command> commands_;
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
  const CommonOptions& common = line.common();
  take_at_most(common.max_memory);
  allow_outside_files(common.outside);
  OutputSetOptions options{common.force, {}, {}};
  if (!common.no_record) options.record = record_of(*used);
  OutputSet outputs(std::move(options));
  used->run();
  outputs.publish();
  return used->exit_code ? used->exit_code() : 0;
}

std::vector<std::string> words_of(const std::string& command) { return CLI::detail::split_up(command); }

void check_command(const std::vector<std::string>& words) {
  CommandLine line;
  line.parse(words);
}

void run_quietly(std::vector<std::string> words) { run_command(CommandLine().quiet(std::move(words))); }

void repeat_command(const Repetition& repetition) {
  require_recorded(repetition.words);
  CommandLine line;
  const Command& command =
      line.parse(line.quiet(words_to_repeat(repetition.words, repetition.folder, repetition.file)));
  Record record = record_of(command);
  record.version = repetition.version;
  record.architecture = repetition.architecture;
  allow_outside_files(line.common().outside);
  OutputSet outputs({false, repetition.confinement, std::move(record)});
  command.run();
  outputs.publish();
}

}  // namespace pelage
