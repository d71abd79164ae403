#include "recipe/text_limits.h"

#include <gtest/gtest.h>

#include "pelage/error.h"
#include "pelage/recipe.h"
#include "recipe/document.h"

namespace pelage {
namespace {

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

std::string error_of(const std::string& text) {
  try {
    parse_document(text, "r.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string too_deep = "r.toml:2: tables, arrays and dotted keys are more than 64 deep here";

TEST(TextLimits, DepthIsThatOfEveryWayToNest) {
  for (const std::size_t depth : {63, 65}) {
    const std::string parts = repeated("a.", depth);
    const std::string nested[] = {
        "\n" + parts + "b = 1\n",                                                    // a dotted key
        "\n" + repeated("a . ", depth) + "b = 1\n",                                  // with blanks
        "\n" + repeated("\"x=[\".", depth) + "b = 1\n",                              // in quotes
        "\n[" + parts + "b]\n",                                                      // a header
        "\n[[" + parts + "b]]\n",                                                    // of several tables
        "\na = " + repeated("[", depth) + repeated("]", depth) + "\n",               // arrays
        "\na = " + repeated("{a=", depth) + "1" + repeated("}", depth) + "\n",       // tables in lines
        "[" + repeated("a.", 31) + "b]\n" + repeated("a.", depth - 32) + "b = 1\n",  // a key below a header
        "x = 1\na = [1, " + repeated("{a=", depth - 1) + "1" + repeated("}", depth - 1) + "]\n",  // both
    };
    for (const std::string& text : nested) {
      if (depth < deepest_text)
        EXPECT_EQ(error_of(text), "") << text;
      else
        EXPECT_EQ(error_of(text), too_deep) << text;
    }
  }
}

TEST(TextLimits, WhatIsNoKeyAndNoBracketDoesNotCount) {
  EXPECT_EQ(error_of("a = '" + repeated("[", 100) + repeated(".", 100) + "'\n"), "");
  EXPECT_EQ(error_of("a = \"\\\"" + repeated("[", 100) + "\"\n"), "");
  EXPECT_EQ(error_of("a = \"\"\"\n\\\n" + repeated("{", 100) + "\\\"\"\" \"\"\"\n"), "");
  EXPECT_EQ(error_of("# " + repeated("[a.", 100) + "\na = 1"), "");
  EXPECT_EQ(error_of("a = [" + repeated("1.5, ", 30000) + "]\n"), "");  // a long outline
  EXPECT_EQ(error_of("a = [" + repeated("[1.5, 2.5],\n", 30000) + "]\n"), "");
  EXPECT_EQ(error_of(repeated("[[a]]\nb.c = {d = 1.5}\n", 4000)), "");
}

TEST(TextLimits, KeysAreCounted) {
  std::string keys;
  for (std::size_t i = 0; i < most_keys; ++i) keys += "k" + std::to_string(i) + "=1\n";
  EXPECT_EQ(error_of(keys), "");
  EXPECT_EQ(error_of(keys + "more=1\n"), "r.toml:20001: there are more than 20000 keys; nothing needs so many");
  EXPECT_NE(error_of(repeated("[[a]]\n", most_keys + 1)).find("20000 keys"), std::string::npos);
  EXPECT_NE(error_of(repeated("a.a=1\n", most_keys / 2 + 1)).find("20000 keys"), std::string::npos);
  EXPECT_NE(error_of("a = [" + repeated("{b=1},", most_keys + 1) + "]").find("20000 keys"), std::string::npos);
}

TEST(TextLimits, MonstersAreRefusedBeforeTheyAreParsed) {
  EXPECT_EQ(error_of("\n" + repeated("a.", 10000) + "a = 1"), too_deep);
  EXPECT_EQ(error_of("\na = " + repeated("[", 100000)), too_deep);
  EXPECT_EQ(error_of("\n[" + repeated("a.", 10000)), too_deep);
  EXPECT_EQ(error_of("\na = " + repeated("{a.a=", 10000)), too_deep);
  EXPECT_EQ(error_of("a = '''" + repeated("x", largest_text)),
            "r.toml: is larger than 1 MB; this is no model or recipe");
  for (const char* broken : {"\"", "'''", "\"\"\"\\", "\"\\", "a = \"", "]", "}}}", "[[", "{,", ",,,", "=", "..."})
    EXPECT_NE(error_of(broken), "") << broken;
}

TEST(TextLimits, ARecipeHasAtMostAHundredStages) {
  const std::string stage = "[[stage]]\nmodel = \"turing\"\n";
  EXPECT_EQ(parse_recipe(repeated(stage, 100), "r.toml").stages.size(), 100U);
  try {
    parse_recipe(repeated(stage, 9000), "r.toml");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "r.toml:201:1: a recipe has at most 100 stages");
  }
}

}  // namespace
}  // namespace pelage
