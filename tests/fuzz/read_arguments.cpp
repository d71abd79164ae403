#include "fuzz/read_arguments.h"

#include "catalog/plan.h"
#include "commands.h"
#include "grow_options.h"
#include "usage.h"

namespace pelage {

namespace {

std::vector<std::string> words_of(std::string_view lines) {
  std::vector<std::string> words;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view word = lines.substr(0, end);
    words.emplace_back(word.substr(0, word.find('\0')));  // as the system passes them
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return words;
}

/// False if help was asked for.
bool parse(CLI::App& app, const std::vector<Command>& commands, const std::vector<std::string>& words) {
  try {
    parse_arguments(app, commands, words);
    return true;
  } catch (const CLI::Success&) {
    return false;
  }
}

void plan_growth(const std::vector<std::string>& words) {
  CLI::App app("", "pelage");
  GrowOptions options;
  CLI::App* grow = app.add_subcommand("grow");
  add_options(*grow, options);
  if (parse(app, {{grow, [] {}}}, words)) plan(make_recipe(options));
}

}  // namespace

void read_arguments(std::string_view lines) {
  const std::vector<std::string> words = words_of(lines);
  if (words.empty()) return;
  if (words.front() == "grow") plan_growth(words);
  CLI::App app("", "pelage");
  CommonOptions common;
  parse(app, add_commands(app, common), words);
}

}  // namespace pelage
