#include "recipe/document.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "pelage/recipe.h"

namespace pelage {
namespace {

std::string error_of(const std::function<void()>& action, Fault fault = Fault::usage) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

const char* const text = R"(title = "coat"
count = 3
size = 1.5e-2
closed = true
[zebra]
x = 1
[ant]
list = ["a", { k = 2 }]
)";

TEST(Document, ReadsValuesInTheOrderOfTheFile) {
  const Value d = parse_document(text, "r.toml");
  EXPECT_EQ(d.at("title").string(), "coat");
  EXPECT_EQ(d.at("count").number(), 3);
  EXPECT_EQ(d.at("size").number(), 0.015);
  EXPECT_TRUE(d.at("closed").boolean());
  EXPECT_EQ(d.at("ant").at("list").items()[1].at("k").number(), 2);
  std::string keys;
  for (const auto& [key, value] : d.entries()) keys += key + " ";
  EXPECT_EQ(keys, "title count size closed zebra ant ");
  EXPECT_EQ(to_string(d.at("count").where()), "r.toml:2:9");
  EXPECT_EQ(to_string(d.at("title").text_where()), "r.toml:1:10");
}

TEST(Document, LocatesTheTextInsideQuotes) {
  const Value d = parse_document("a = '''\nfirst\n'''\nb = \"\"\"x\"\"\"\n\"\xC3\xA4\" = { c = 'y' }\n", "r.toml");
  EXPECT_EQ(to_string(d.at("a").text_where()), "r.toml:2:1");
  EXPECT_EQ(to_string(d.at("b").text_where()), "r.toml:4:8");
  EXPECT_EQ(to_string(d.at("\xC3\xA4").at("c").text_where()), "r.toml:5:14");
}

TEST(Document, UnreadKeysAreFaults) {
  const Value d = parse_document(text, "r.toml");
  d.find("titel");
  d.find("count");
  d.find("size");
  EXPECT_EQ(error_of([&] { d.require_all_read(); }), "r.toml:1:1: unknown key \"title\"; did you mean \"titel\"?");
  d.at("title").string();
  d.at("count").number();
  d.at("size").number();
  d.at("closed").boolean();
  d.at("zebra").at("x").number();
  EXPECT_EQ(error_of([&] { d.require_all_read(); }), "r.toml:7:2: unknown key \"ant\"; unused here are titel");
  for (const Value& item : d.at("ant").at("list").items())
    if (item.kind() == Value::Kind::string) item.string();
  EXPECT_EQ(error_of([&] { d.require_all_read(); }), "r.toml:8:16: unknown key \"k\"");
}

TEST(Document, KindsAndMissingKeys) {
  const Value d = parse_document(text, "r.toml");
  EXPECT_EQ(error_of([&] { d.at("title").number(); }), "r.toml:1:9: expected a number, found a string");
  EXPECT_EQ(error_of([&] { d.at("count").find("x"); }), "r.toml:2:9: expected a table, found a number");
  EXPECT_EQ(error_of([&] { d.at("zebra").at("y"); }), "r.toml:5:1: \"y\" is missing; add it");
  EXPECT_EQ(error_of([&] { d.at("sise"); }), "r.toml:3:1: unknown key \"size\"; did you mean \"sise\"?");
  EXPECT_EQ(d.number_or("none", 4), 4);
  EXPECT_EQ(d.string_or("none", "s"), "s");
}

TEST(Document, FaultsOfTheFormat) {
  EXPECT_EQ(error_of([] { parse_document("a = 1\nb = = 2\n", "r.toml"); }).substr(0, 12), "r.toml:2:5: ");
  EXPECT_EQ(error_of([] { parse_document("a = 1\na = 2\n", "r.toml"); }).substr(0, 9), "r.toml:2:");
  EXPECT_EQ(error_of([] { parse_document("d = 2020-01-01\n", "r.toml"); }),
            "r.toml:1:5: dates and times have no meaning here");
  EXPECT_EQ(error_of([] { read_document("/nonexistent.toml"); }, Fault::input),
            "/nonexistent.toml: cannot be read; check the path");
}

TEST(Document, FoldersAndLargeFilesAreNoDocuments) {
  const std::filesystem::path folder = std::filesystem::path(PELAGE_BINARY_DIR) / "test-files" / "Document";
  std::filesystem::create_directories(folder / "folder.toml");
  const std::string large = (folder / "large.toml").string(), whole = (folder / "whole.toml").string();
  std::ofstream(large) << std::string((1 << 20) + 1, '#');
  std::ofstream(whole) << std::string(1 << 20, '#');
  const std::string path = (folder / "folder.toml").string();
  EXPECT_EQ(error_of([&] { read_document(path); }, Fault::input),
            path + ": is a folder; give the path of a .toml file");
  EXPECT_EQ(error_of([&] { read_text(large); }, Fault::input),
            large + ": is larger than 1 MB; this is no model or recipe");
  EXPECT_EQ(read_text(whole).size(), std::size_t{1 << 20});
}

TEST(Recipe, WholeNumbersHaveLimits) {
  const auto recipe = [](const std::string& look, const std::string& stage = "") {
    return parse_recipe("[stage]\nmodel = \"turing\"\n" + stage + "\n[look]\n" + look, "r.toml");
  };
  EXPECT_EQ(recipe("detail = 10").look.detail, 10);
  for (const std::string detail : {"-1", "1.5", "11", "1e12", "1e300", "inf", "nan"})
    EXPECT_EQ(error_of([&] { recipe("detail = " + detail); }), "r.toml:5:10: expected a whole number from 0 to 10");
  EXPECT_EQ(error_of([&] { recipe("", "seed = 1e16"); }),
            "r.toml:3:8: expected a whole number from 0 to 9000000000000000");
}

}  // namespace
}  // namespace pelage
