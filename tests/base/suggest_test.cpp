#include "base/suggest.h"

#include <gtest/gtest.h>

namespace pelage {
namespace {

TEST(Suggest, NamesMatchWithoutCaseWhereOneDoes) {
  const std::vector<std::string> names = {"Heat", "mask", "Mask"};
  EXPECT_EQ(matching_name("HEAT", names), &names[0]);
  EXPECT_EQ(matching_name("Mask", names), &names[2]);
  EXPECT_EQ(matching_name("MASK", names), nullptr);
  EXPECT_EQ(matching_name("hea", names), nullptr);
}

TEST(Suggest, DistanceCountsSlips) {
  EXPECT_EQ(edit_distance("turing", "turing"), 0);
  EXPECT_EQ(edit_distance("turing", "Turing"), 0);
  EXPECT_EQ(edit_distance("turing", "truing"), 1);   // swap
  EXPECT_EQ(edit_distance("turing", "turng"), 1);    // deletion
  EXPECT_EQ(edit_distance("turing", "tturing"), 1);  // insertion
  EXPECT_EQ(edit_distance("turing", "tuning"), 1);   // replacement
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
}

TEST(Suggest, DistanceIsSymmetric) {
  const std::vector<std::string> words = {"", "a", "ab", "ba", "leopard", "leoprad", "giraffe", "zebra"};
  for (const std::string& a : words)
    for (const std::string& b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << " " << b;
}

TEST(Suggest, NamesTheNearestAndOnlyTheLikely) {
  const std::vector<std::string> known = {"turing", "gray-scott", "leopard"};
  EXPECT_EQ(did_you_mean("tring", known), "did you mean \"turing\"?");
  EXPECT_EQ(did_you_mean("GRAYSCOTT", known), "did you mean \"gray-scott\"?");
  EXPECT_EQ(did_you_mean("leo", known), "did you mean \"leopard\"?");
  EXPECT_EQ(did_you_mean("xyz", known), "");
  EXPECT_EQ(did_you_mean("", known), "");
  EXPECT_EQ(did_you_mean("turing", {}), "");
}

TEST(Suggest, JoinsNames) { EXPECT_EQ(join_names({"a", "b"}), "a, b"); }

}  // namespace
}  // namespace pelage
