#include "usage.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/suggest.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// "see pelage grow --help", for the command in use.
std::string help_hint(const CLI::App& app) {
  std::string command = app.get_name();
  for (const CLI::App* used : app.get_subcommands()) command += " " + used->get_name();
  return "see " + command + " --help";
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// Of "Could not convert: --steps = x".
std::string conversion(const std::string& text, const CLI::App& app) {
  const std::size_t colon = text.find(": "), equals = text.find(" = ", colon);
  if (colon == std::string::npos || equals == std::string::npos) return text;
  const std::string name = text.substr(colon + 2, equals - colon - 2);
  for (const CLI::App* used : app.get_subcommands())
    if (const CLI::Option* option = used->get_option_no_throw(name); option && option->get_items_expected_max() == 0)
      return name + " takes no value";
  return name + ": \"" + text.substr(equals + 3) + "\" is not a number";
}

/// CLI11 names the option in front of the first colon.
std::string message(const CLI::ParseError& error, const CLI::App& app) {
  std::string text = error.what();
  if (error.get_name() == "ConversionError") return conversion(text, app);
  const std::string option = text.substr(0, text.find(':'));
  if (error.get_name() != "ArgumentMismatch") return text;
  return option + (text.find("missing") != std::string::npos ? " needs a value" : " is given more than once");
}

std::string unknown_option(const std::string& argument, const CLI::App& app) {
  const std::string name = argument.substr(0, argument.find('='));
  const bool is_letter = name.size() <= 2;  // any other letter would be as near
  const std::string hint = is_letter ? "" : did_you_mean(name, option_names(app));
  return "unknown option \"" + name + "\"; " + (hint.empty() ? "" : hint + " ");
}

std::string unknown_command(const std::string& word, const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.app->get_name());
  if (word == "version") return "unknown command \"version\"; did you mean \"--version\"? ";
  return unknown_name("command", word, names) + "; ";
}

/// An argument that has no place.
std::string one_too_many(const std::string& argument, const CLI::App& app) {
  const bool setting = argument.find('=') != std::string::npos && app.get_option_no_throw("--set");
  return "too many arguments: \"" + argument + "\" is one more than expected; " +
         (setting ? "parameters are written --set " + argument + "; " : "");
}

/// CLI11 would take the next option for the value.
void refuse_missing_values(const std::vector<std::string>& words, const std::vector<Command>& commands) {
  const auto used = std::ranges::find(commands, words.front(), [](const Command& c) { return c.app->get_name(); });
  if (used == commands.end()) return;
  const std::vector<std::string> names = option_names(*used->app);
  const auto is_option = [&](const std::string& word) { return std::ranges::count(names, word) > 0; };
  for (std::size_t k = 1; k + 1 < words.size(); ++k)
    if (is_option(words[k]) && is_option(words[k + 1]) && used->app->get_option(words[k])->get_items_expected_min() > 0)
      throw Error(Fault::usage, words[k] + " needs a value; see pelage " + words.front() + " --help");
}

/// Arguments that nobody wanted.
void refuse_rest(const CLI::App& app, const std::vector<Command>& commands) {
  const std::vector<std::string> rest = app.remaining(true);
  if (rest.empty()) return;
  const bool has_command = !app.get_subcommands().empty();
  const CLI::App& used = has_command ? *app.get_subcommands().front() : app;
  for (const std::string& argument : rest)
    if (argument.size() > 1 && argument[0] == '-')
      throw Error(Fault::usage, unknown_option(argument, used) + help_hint(app));
  throw Error(Fault::usage, (has_command ? one_too_many(rest.front(), used) : unknown_command(rest.front(), commands)) +
                                help_hint(app));
}

/// `help COMMAND` is `COMMAND --help`.
std::vector<std::string> help_instead(const std::vector<std::string>& words, const std::vector<Command>& commands) {
  if (words.size() == 1) return {"--help"};
  if (std::ranges::none_of(commands, [&](const Command& c) { return c.app->get_name() == words[1]; }))
    throw Error(Fault::usage, unknown_command(words[1], commands) + "see pelage --help");
  return {words[1], "--help"};
}

std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

CLI::Validator number_check(const std::string& wanted, bool (*fits)(double)) {
  return CLI::Validator(
      [wanted, fits](std::string& text) {
        const std::optional<double> value = parse_number(text);
        return value && fits(*value) ? "" : "\"" + text + "\" is not " + wanted;
      },
      "");
}

}  // namespace

const Command& parse_arguments(CLI::App& app, const std::vector<Command>& commands, std::vector<std::string> words) {
  app.allow_extras();
  for (const Command& command : commands) command.app->allow_extras();
  if (words.front() == "help") words = help_instead(words, commands);
  refuse_missing_values(words, commands);
  try {
    std::ranges::reverse(words);  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::Success&) {
    throw;
  } catch (const CLI::ParseError& error) {
    throw Error(Fault::usage, message(error, app) + "; " + help_hint(app));
  }
  refuse_rest(app, commands);
  for (const Command& command : commands)
    if (command.app->parsed()) return command;
  throw Error(Fault::usage, "no command given; " + help_hint(app));
}

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  return CLI::Validator(
      [least, most](std::string& text) -> std::string {
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc{} && end == text.data() + text.size() && value >= least && value <= most) return "";
        return "\"" + text + "\" is not a whole number from " + std::to_string(least) + " to " + std::to_string(most);
      },
      "");
}

CLI::Validator positive_number() {
  return number_check("a number greater than 0", [](double x) { return x > 0; });
}

CLI::Validator number_at_least_zero() {
  return number_check("a number of at least 0", [](double x) { return x >= 0; });
}

}  // namespace pelage
