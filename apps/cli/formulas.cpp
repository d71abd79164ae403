// pelage formulas: the language that models and recipes are written in.

#include <algorithm>
#include <cstdio>
#include <memory>

#include "command.h"
#include "react/language.h"

namespace pelage {

namespace {

void print_words(const std::vector<Word>& list) {
  std::size_t width = 0;
  for (const Word& word : list) width = std::max(width, word.usage.size());
  std::string_view group;
  for (const Word& word : list) {
    if (word.group != group) std::printf("\n%s\n", std::string(group = word.group).c_str());
    std::printf("  %-*s  %s\n", static_cast<int>(width), word.usage.c_str(), word.meaning.c_str());
  }
}

std::vector<Word> language() {
  std::vector<Word> list = operators();
  list.insert(list.end(), words().begin(), words().end());
  return list;
}

void print_language() {
  std::puts(
      "Formulas are made of numbers, of the names of the model (species in rates, parameters, definitions above),");
  std::puts("in recipes also of STAGE.SPECIES for the fields of earlier stages, and of these:");
  print_words(language());
}

void print_language_as_json() {
  Json list = Json::array();
  for (const Word& word : language())
    list.push_back({{"group", std::string(word.group)}, {"usage", word.usage}, {"meaning", word.meaning}});
  print_json(list);
}

}  // namespace

Command add_formulas(CLI::App& parent) {
  auto json = std::make_shared<bool>(false);
  CLI::App* app = parent.add_subcommand(
      "formulas",
      "Print the language of formulas\n"
      "Every operator, name and function that formulas of models, recipes and --param-map may use.");
  app->add_flag("--json", *json, "Print the result as JSON: an array of words");
  app->footer("Examples:\n  pelage formulas\n  pelage formulas --json");
  return {app, [json] { *json ? print_language_as_json() : print_language(); }};
}

}  // namespace pelage
