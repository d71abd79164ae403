#include "react/language.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "pelage/error.h"
#include "react/formula.h"
#include "react/functions.h"

namespace pelage {
namespace {

/// The names that stand for arguments, as constants; u and v are species, and vectors of constants.
Scope scope_of_examples(Graph& graph) {
  Scope scope;
  for (const char* name : {"a", "b", "x", "edge", "edge0", "lower", "mean", "length", "condition"})
    scope.names[name] = graph.constant(1);
  for (const char* name : {"edge1", "upper", "deviation", "seed"}) scope.names[name] = graph.constant(2);
  scope.names["c"] = graph.constant(1);
  scope.names["u"] = graph.symbol({Symbol::Kind::species, 0});
  scope.names["v"] = graph.symbol({Symbol::Kind::species, 1});
  for (const char* name : {"u_1", "u_2", "u_3", "v_1", "v_2", "v_3"}) scope.names[name] = graph.constant(1);
  return scope;
}

TEST(Language, EveryUsageIsAFormula) {
  for (const Word& word : words()) {
    Graph graph;
    // A gradient stands in others only.
    const std::string usage = word.usage == "grad u" ? "dot(grad u, grad u)" : word.usage;
    EXPECT_NO_THROW(parse_formula(graph, {usage, {}, 1}, scope_of_examples(graph), "test")) << word.usage;
    EXPECT_FALSE(word.meaning.empty()) << word.usage;
    EXPECT_EQ(word.meaning.find('|'), std::string::npos) << "would end a column: " << word.usage;
  }
}

TEST(Language, EveryNameIsReservedAndNothingElse) {
  std::set<std::string> names = {"and", "or", "not"};
  for (const Word& word : words()) names.emplace(word.name());
  const std::set<std::string> reserved(reserved_names().begin(), reserved_names().end());
  EXPECT_EQ(names, reserved);
  for (const Function& f : pure_functions()) EXPECT_TRUE(names.contains(std::string(f.name))) << f.name;
}

/// What the page says: "| `usage` | meaning |", below the heading.
std::set<std::string> rows_of_page() {
  std::ifstream page(PELAGE_SOURCE_DIR "/docs/models.md");
  std::set<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) inside = line == "## The language of formulas";
    if (inside && line.starts_with("| `")) rows.insert(line);
  }
  return rows;
}

TEST(Language, ThePageHasTheSameTable) {
  std::set<std::string> expected;
  for (const auto* list : {&operators(), &words()})
    for (const Word& word : *list) expected.insert("| `" + word.usage + "` | " + word.meaning + " |");
  EXPECT_EQ(rows_of_page(), expected);
}

}  // namespace
}  // namespace pelage
