#pragma once
// A subcommand: its options, and what it does after they are parsed.

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "shape/finding.h"

namespace pelage {

using Json = nlohmann::ordered_json;

struct Command {
  CLI::App* app;
  std::function<void()> run;  ///< throws Error
  /// Where the command stands for another one: its words, which take its place.
  std::function<std::vector<std::string>()> stands_for = {};
  /// Of a command that answers a question: asked after run().
  std::function<int()> exit_code = {};
};

Command add_grow(CLI::App& parent);
Command add_check(CLI::App& parent);
Command add_models(CLI::App& parent);
Command add_formulas(CLI::App& parent);
Command add_analyse(CLI::App& parent);
Command add_map(CLI::App& parent);
Command add_gallery(CLI::App& parent);
Command add_fair(CLI::App& parent);
Command add_figures(CLI::App& parent);
Command add_field(CLI::App& parent);
Command add_compare(CLI::App& parent);
Command add_grid(CLI::App& parent);
Command add_cells(CLI::App& parent);
Command add_measure(CLI::App& parent);
Command add_recipes(CLI::App& parent);
Command add_resume(CLI::App& parent);
Command add_again(CLI::App& parent);
Command add_explain(CLI::App& parent);
Command add_sheet(CLI::App& parent);
Command add_render(CLI::App& parent);
Command add_studio(CLI::App& parent);
Command add_unwrap(CLI::App& parent);
Command add_verify(CLI::App& parent);

/// Prints to stdout, indented; text that is not UTF-8 gets replacement characters.
void print_json(const Json& json);

/// Numbers that JSON does not know (infinite ones) and missing ones become null.
Json json_number(double value);
Json json_number(const std::optional<double>& value);

Json json_findings(const std::vector<Finding>& findings);

}  // namespace pelage
