#include "recipe/paper.h"

#include <gtest/gtest.h>

namespace pelage {
namespace {

std::string fault(const std::string& text) {
  try {
    parse_paper(text, "own.toml", "own");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string head = "title = 'T'\n[[figure]]\nnumber = '2'\nshows = 'spots'\n";

TEST(Paper, KeepsWhatTheTextSays) {
  const Paper paper = parse_paper(head +
                                      "verdict = 'otherwise'\nsaid = 'why'\n[[figure.panel]]\ncaption = 'c'\n"
                                      "run = '''grow a\n\ngrow b'''\npicture = 'p.png'\ncoat = 'p.vtp'\nfield = 'b'\n",
                                  "own.toml", "own");
  EXPECT_EQ(paper.name, "own");
  ASSERT_EQ(paper.figures.size(), 1U);
  EXPECT_EQ(paper.figures[0].verdict, FigureVerdict::otherwise);
  const FigurePanel& panel = paper.figures[0].panels.at(0);
  ASSERT_EQ(panel.commands.size(), 2U);
  EXPECT_EQ(panel.commands[1].value, "grow b");
  EXPECT_EQ(panel.commands[1].where.line, panel.commands[0].where.line + 2);
  EXPECT_EQ(panel.picture, "p.png");
  EXPECT_EQ(panel.coat, "p.vtp");
  EXPECT_EQ(panel.field, "b");
}

TEST(Paper, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(fault(head + "verdict = 'mad'").find("own.toml:5"), std::string::npos);
  EXPECT_NE(fault(head + "verdict = 'mad'").find("did you mean \"made\""), std::string::npos);
  EXPECT_NE(fault(head + "verdict = 'misprint'").find("'said'"), std::string::npos);
  EXPECT_NE(fault(head + "verdict = 'made'\nverdikt = 1").find("verdikt"), std::string::npos);
  const std::string panel = head + "verdict = 'made'\n[[figure.panel]]\npicture = 'p.png'\n";
  EXPECT_NE(fault(panel).find("run"), std::string::npos);
  EXPECT_NE(fault(panel + "run = ''").find("a command at least"), std::string::npos);
  EXPECT_NE(fault(panel + "run = 'grow'\ncoat = 'p.vtp'").find("go together"), std::string::npos);
}

}  // namespace
}  // namespace pelage
