#include "catalog/skeleton.h"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "catalog/models.h"
#include "pelage/error.h"

namespace pelage {
namespace {

/// The keys that the reader knows in a table: those that it misses where one is unknown.
std::vector<std::string> keys_in(const std::string& table) {
  try {
    parse_model("name = \"m\"\n" + table + "zzzzzzzz = 1\n", "m.toml");
  } catch (const Error& error) {
    std::string text = error.what();
    const std::string before = "unused here are ";
    EXPECT_NE(text.find(before), std::string::npos) << text;
    text = text.substr(text.find(before) + before.size());
    std::vector<std::string> keys;
    std::istringstream words(std::regex_replace(text, std::regex(","), " "));
    for (std::string key; words >> key;) keys.push_back(key);
    return keys;
  }
  ADD_FAILURE() << "an unknown key in " << table;
  return {};
}

TEST(Skeleton, HasAllKeysOfAModelFile) {
  const std::string text = model_skeleton("mine");
  for (const std::string table : {"", "[species.u]\n", "[species.u]\nanisotropy.a1 = 1\nanisotropy.a2 = 1\nanisotropy.",
                                  "[species.u]\ntensor.xx = 1\ntensor.yy = 1\ntensor.zz = 1\ntensor.",
                                  "[parameters.a]\nvalue = 1\n", "[suggested]\n", "[variants.v]\n"})
    for (const std::string& key : keys_in(table))
      EXPECT_TRUE(key == "stage" ||  // by which recipes are told from models
                  std::regex_search(text, std::regex("(^|[\\s\\[{.])" + key + "( =|\\]|\\.)")))
          << key << " of " << table;
}

/// Each by itself may contradict another key, but is known and has a value of the right kind.
TEST(Skeleton, EveryKeyThatIsAComment) {
  const std::string text = model_skeleton("mine");
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch key;
    if (!std::regex_match(line, key, std::regex("# ([A-Za-z0-9]+ = .*)"))) continue;
    ++count;
    std::string changed = text;
    changed.replace(changed.find(line), line.size(), key[1]);
    EXPECT_NO_THROW(parse_model(changed, "mine.toml")) << line;
  }
  EXPECT_GT(count, 10);
}

TEST(Skeleton, RefusesNamesThatAreNoneForAFile) {
  for (const char* name : {"", "a b", "../a", "a.toml"}) EXPECT_THROW(model_skeleton(name), Error) << name;
  EXPECT_EQ(parse_model(model_skeleton("a-1_b"), "").name, "a-1_b");
}

}  // namespace
}  // namespace pelage
