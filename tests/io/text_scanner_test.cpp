#include "io/text_scanner.h"

#include "io/read_text.h"

namespace pelage {
namespace {

TEST(TextScanner, WordsLinesCommentsAndContinuations) {
  TextScanner text("\xEF\xBB\xBF one\ttwo # three\r\n\r\nfo\\ur \\ \r\n five#not six\rsix\x1a", "f");
  EXPECT_EQ(text.word(), "one");
  EXPECT_EQ(text.word(), "two");
  EXPECT_TRUE(text.at_line_end());
  EXPECT_EQ(text.word(), "");
  EXPECT_FALSE(text.at_end());
  EXPECT_EQ(text.line(), 3);
  EXPECT_EQ(text.word(), "fo\\ur");  // a backslash in a word is part of it
  EXPECT_EQ(text.word(), "five");
  EXPECT_FALSE(text.at_end());
  EXPECT_EQ(text.line(), 5);
  EXPECT_EQ(text.word(), "six");
  EXPECT_TRUE(text.at_end());
  TextScanner continued("a\\\n b\nc", "f");
  EXPECT_EQ(continued.word(), "a");
  EXPECT_EQ(continued.word(), "b");
  EXPECT_EQ(continued.line(), 2);
}

TEST(TextScanner, NamesReachToTheEndOfTheLine) {
  TextScanner text("usemtl  Red fur #2 \r\nnext", "f");
  text.word();
  EXPECT_EQ(text.rest_of_line(), "Red fur #2");
  text.skip_line();
  EXPECT_EQ(text.word(), "next");
}

TEST(TextScanner, WideTextsAreNamed) {
  const std::string narrow = "v 0 0 0\nv 1 0 0\n";
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (char c : narrow) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& text : {little, big, little.substr(2), big.substr(2)})
    test::expect_input_error([&] { refuse_wide_text(text, "f"); }, "f: is UTF-16 text; save it as UTF-8");
  refuse_wide_text(narrow, "f");
  refuse_wide_text(std::string(100, '\0'), "f");
}

double number(const char* word) { return TextScanner(word, "f").number("a number"); }

TEST(TextScanner, Numbers) {
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("+1.5e+3"), 1500);
  EXPECT_EQ(number("-.5"), -0.5);
  EXPECT_EQ(number("3."), 3);
  EXPECT_EQ(number("1E-400"), 0);
  EXPECT_TRUE(number("nan") != number("nan"));
  EXPECT_EQ(TextScanner("-12", "f").integer("an integer"), -12);
  for (const char* bad : {"1.0D-05", "0,5", "1.5,", "1.5x", "--1", "+-1", "x1", "0x10", "1e999", "-", "+"})
    test::expect_input_error([&] { number(bad); }, "f:1: ");
  for (const char* bad : {"1.5", "99999999999999999999", "a", "1,"})
    test::expect_input_error([&] { TextScanner(bad, "f").integer("an integer"); }, "f:1: ");
  test::expect_input_error([] { number("0,5"); }, "point");
}

TEST(TextScanner, QuotesUnprintableAndLongWords) {
  EXPECT_EQ(in_quotes("a\x01\xff"), "\"a??\"");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "\"" + std::string(40, 'x') + "...\"");
}

}  // namespace
}  // namespace pelage
