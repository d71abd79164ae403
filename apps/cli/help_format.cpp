#include "help_format.h"

#include "text.h"

namespace pelage {

namespace {

constexpr std::size_t first_column = 30, line_width = 100;

std::string without_end(std::string text) {
  text.resize(text.find_last_not_of('\n') + 1);
  return text;
}

}  // namespace

HelpFormat::HelpFormat() {
  column_width(first_column);
  label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
  for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
  if (const std::size_t at = text.find("\nSubcommands:"); at != std::string::npos) text.replace(at + 1, 11, "Commands");
  return text;
}

std::string HelpFormat::make_description(const CLI::App* app) const {
  const std::string text = app->get_description();
  const std::size_t end = text.find('\n');
  std::string result = wrapped(text.substr(0, end), 0, line_width);
  if (end != std::string::npos) result += "\n" + wrapped(text.substr(end), 0, line_width);
  return result + "\n";
}

std::string HelpFormat::make_subcommand(const CLI::App* app) const {
  const std::string text = app->get_description();
  return "  " + app->get_name() + std::string(first_column - 2 - app->get_name().size(), ' ') +
         text.substr(0, text.find('\n')) + "\n";
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  return without_end(wrapped(option->get_description(), 0, line_width - first_column));
}

}  // namespace pelage
