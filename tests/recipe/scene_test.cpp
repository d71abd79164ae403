#include "recipe/scene.h"

#include <gtest/gtest.h>

namespace pelage {
namespace {

const std::string ball = "[[thing]]\nshape = \"builtin:sphere\"\n";

TEST(Scene, KeepsWhatTheTextSays) {
  const Scene scene = parse_scene(
      "name = \"table\"\nexposure = 0.5\nbackground = \"#ff0000\"\n[camera]\nazimuth = 10\naspect = 1.5\n[lamp]\nsize "
      "= 0.1\n" +
          ball + "recipe = \"zebra\"\nsize = 0.05\nseed = 7\nat = [1, 2, 3]\nturn = 90\n" +
          "[[thing]]\nturned = [[0, 0], [1, 0], [0, 1]]\nframed = false\nplaces = [{}, { scale = 2 }]\n" +
          "material = { color = \"#00ff00\", roughness = 0.2 }\n",
      "table.toml");
  EXPECT_EQ(scene.name, "table");
  EXPECT_EQ(scene.camera.azimuth, 10);
  EXPECT_EQ(scene.camera.elevation, 14);
  EXPECT_EQ(scene.lamp.size, 0.1);
  ASSERT_EQ(scene.things.size(), 2U);
  EXPECT_EQ(scene.things[0].recipe_name->value, "zebra");
  EXPECT_EQ(scene.things[0].seed, 7U);
  EXPECT_EQ(scene.things[0].places.at(0).at, (Point{1, 2, 3}));
  EXPECT_EQ(scene.things[1].turned.size(), 3U);
  EXPECT_FALSE(scene.things[1].framed);
  EXPECT_EQ(scene.things[1].places.at(1).scale, 2);
  EXPECT_EQ(scene.things[1].material.at(Channel::roughness), 0.2);
}

TEST(Scene, HoldsRecipesOfItsOwn) {
  const Scene scene =
      parse_scene(ball + "[thing.stage]\nmodel = \"gray-scott\"\n[thing.look]\ndisplace = true\n", "s.toml");
  ASSERT_TRUE(scene.things[0].recipe);
  EXPECT_EQ(scene.things[0].recipe->stages.at(0).model.value, "gray-scott");
  EXPECT_TRUE(scene.things[0].recipe->look.displace);
}

/// Every fault names the file and the line on which it is.
TEST(Scene, FaultsHaveAPlace) {
  struct Case {
    std::string text;
    int line;
    std::string words;
  };
  for (const Case& c : {Case{"name = \"nothing\"\n", 0, "thing"},
                        {ball + "color = 1\n", 3, "color"},
                        {"[camera]\nelevation = 90\n" + ball, 2, "elevation"},
                        {"[lamp]\nsize = 0\n" + ball, 2, "size"},
                        {"[[thing]]\nat = [0, 0, 0]\n", 1, "shape"},
                        {ball + "turned = [[0, 0], [1, 0], [0, 1]]\n", 1, "either"},
                        {ball + "at = [0, 0]\n", 3, "3 numbers"},
                        {ball + "recipe = \"zebra\"\n[thing.stage]\n", 3, "not both"},
                        {ball + "recipe = \"zebra\"\nmaterial = { roughness = 0 }\n", 4, "without a coat"},
                        {ball + "material = { roughness = 2 }\n", 3, "roughness"},
                        {"[[thing]]\nturned = [[0, 0], [-1, 0], [0, 1]]\n", 2, "radius"},
                        {"[[thing]]\nturned = [[0, 0], [1, 0], [1, 1]]\n", 2, "axis"},
                        {"[[thing]]\nturned = [[0, 0], [0, 1]]\n", 2, "three corners"}})
    try {
      parse_scene(c.text, "s.toml");
      ADD_FAILURE() << c.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::usage);
      EXPECT_EQ(error.where().file, "s.toml") << error.what();
      if (c.line > 0) {
        EXPECT_EQ(error.where().line, c.line) << error.what();
      }
      EXPECT_NE(std::string(error.what()).find(c.words), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace pelage
