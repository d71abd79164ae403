#pragma once
// Help as it reads well in a terminal of 100 columns.

#include <CLI/CLI.hpp>

namespace pelage {

/// Descriptions are broken into lines; the list of commands shows the first paragraph of each.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* app) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace pelage
