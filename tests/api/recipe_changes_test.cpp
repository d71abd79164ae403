#include <pelage/grow.h>
#include <pelage/recipe_changes.h>

#include "api_support.h"

namespace pelage::api {
namespace {

Recipe two_stages() {
  return parse_recipe(R"(
stage = [ { name = "large", model = "turing", size = 0.1 }, { name = "small", model = "turing", size = 0.04 } ]
)",
                      "test");
}

std::string message_of(const RecipeChanges& changes) {
  try {
    with_changes(two_stages(), changes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RecipeChanges, SizesKeepTheirProportion) {
  RecipeChanges changes;
  changes.size = "0.2";
  const Recipe recipe = with_changes(two_stages(), changes);
  EXPECT_DOUBLE_EQ(recipe.stages[0].size->value.value, 0.2);
  EXPECT_DOUBLE_EQ(recipe.stages[1].size->value.value, 0.08);
}

TEST(RecipeChanges, ReachTheStageThatTheyName) {
  RecipeChanges changes;
  changes.settings = {"small.s=0.06", "stage1.size=3u"};
  changes.maps = {"large.beta=attribute:age"};
  changes.seed = 9;
  const Recipe recipe = with_changes(two_stages(), changes);
  EXPECT_EQ(recipe.stages[1].parameters.at(0).value, 0.06);
  EXPECT_EQ(recipe.stages[0].size->value.unit, Length::Unit::world);
  EXPECT_EQ(recipe.stages[0].parameters.at(0).formula, "attribute(age)");
  EXPECT_EQ(recipe.stages[0].seed + recipe.stages[1].seed, 18u);
}

TEST(RecipeChanges, TakeThePlaceOfWhatTheRecipeSays) {
  RecipeChanges changes;
  changes.settings = {"s=0.06"};
  const Recipe given = parse_recipe("[stage]\nmodel = \"turing\"\nparameters = { s = 0.05, Da = 0.13 }\n", "test");
  const std::vector<Stage::Setting> parameters = with_changes(given, changes).stages[0].parameters;
  ASSERT_EQ(parameters.size(), 2u);
  EXPECT_EQ(parameters[1].name, "s");
  EXPECT_EQ(parameters[1].value, 0.06);
}

TEST(RecipeChanges, SayWhatIsWrongInTheWordsOfTheirCaller) {
  RecipeChanges changes;
  changes.settings = {"s=0.06"};
  EXPECT_EQ(message_of(changes),
            "set s=0.06: the recipe has several stages; write STAGE.s=..., with one of large, small");
  changes.prefix = "--";
  changes.settings = {"tall.s=0.06"};
  EXPECT_EQ(message_of(changes), "--set tall.s=0.06: unknown stage \"tall\"; known: large, small");
  changes.settings = {};
  changes.unit = "1u";
  EXPECT_EQ(message_of(changes), "--unit: the recipe has several stages; give each of them its own in the recipe");
}

TEST(RecipeChanges, NothingChangesNothing) {
  const Growth before(read_shape("builtin:sphere?n=162"), load_recipe("leopard"));
  const Growth after(read_shape("builtin:sphere?n=162"), with_changes(load_recipe("leopard"), {}));
  EXPECT_EQ(before.checkpoint(), after.checkpoint());
}

}  // namespace
}  // namespace pelage::api
