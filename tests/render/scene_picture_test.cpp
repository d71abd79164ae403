#include <gtest/gtest.h>

#include <algorithm>

#include "base/parallel.h"
#include "catalog/scenes.h"
#include "pelage/render.h"

namespace pelage {
namespace {

/// A red ball on the left and a green one, twice as large, on the right.
const char* const two_balls = R"(
[[thing]]
shape = "builtin:sphere?n=400"
at = [-2, 1, 0]
material = { color = "#ff0000" }
[[thing]]
shape = "builtin:sphere?n=400"
at = [2, 2, 0]
scale = 2
material = { color = "#00ff00", roughness = 0.4 }
)";

struct Seen {
  int count = 0, left = 1 << 20, right = -1;
};

/// The pixels in which one colour is much stronger than another.
Seen seen(const Image& image, int strong, int weak) {
  Seen seen;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float* c = &image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
      if (c[strong] < 2.5F * c[weak] || c[strong] < 0.05F) continue;
      ++seen.count;
      seen.left = std::min(seen.left, x), seen.right = std::max(seen.right, x);
    }
  return seen;
}

Image draw(const BuiltScene& built, double azimuth) {
  PictureOptions options;
  options.width = 120, options.height = 80, options.samples = 8;
  options.azimuth = azimuth, options.elevation = 5;
  options.framed = built.framed;
  return render(built.mesh, options);
}

TEST(ScenePicture, ThingsAreWhereTheCameraSaysThem) {
  const BuiltScene built = build_scene(parse_scene(two_balls, "two.toml"), "", {});
  const Image before = draw(built, 0), behind = draw(built, 180);
  const Seen red = seen(before, 0, 1), green = seen(before, 1, 0);
  EXPECT_LT(red.right, green.left);
  EXPECT_NEAR(green.count / static_cast<double>(red.count), 4, 1.2);
  EXPECT_NEAR((green.right - green.left) / static_cast<double>(red.right - red.left), 2, 0.3);
  EXPECT_GT(seen(behind, 0, 1).left, seen(behind, 1, 0).right);
}

TEST(ScenePicture, SameBitsForAnyNumberOfThreads) {
  std::vector<std::vector<float>> pictures;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    pictures.push_back(draw(build_scene(parse_scene(two_balls, "two.toml"), "", {}), 20).rgb);
  }
  EXPECT_EQ(pictures[0], pictures[1]);
}

/// What is not framed does not make the others smaller, and may reach behind the camera.
TEST(ScenePicture, OnlyFramedThingsMoveTheCamera) {
  const std::string ground =
      "[[thing]]\nshape = \"builtin:plane?n=100\"\nat = [-50, 0, 50]\ntilt = -90\nscale = 100\nframed = false\n"
      "material = { color = \"#0000ff\", roughness = 1 }\n";
  const BuiltScene alone = build_scene(parse_scene(two_balls, "two.toml"), "", {}),
                   together = build_scene(parse_scene(two_balls + ground, "two.toml"), "", {});
  const Image bare = draw(alone, 0), blue = draw(together, 0);
  EXPECT_NEAR(seen(bare, 1, 0).right, seen(blue, 1, 0).right, 2);
  EXPECT_NEAR(seen(bare, 0, 1).left, seen(blue, 0, 1).left, 2);
  EXPECT_GT(seen(blue, 2, 0).count, 120 * 80 / 4);
}

/// Copies turn their normals and scale their lengths.
TEST(ScenePicture, CopiesAreSimilar) {
  const BuiltScene built = build_scene(
      parse_scene("[[thing]]\nshape = \"builtin:sphere?n=400\"\nmaterial = { thickness = 0.5, transmission = 1 }\n"
                  "places = [{}, { at = [3, 0, 0], tilt = 90, scale = 2 }]\n",
                  "s.toml"),
      "", {});
  const std::size_t n = built.mesh.points.size() / 2;
  const auto& normal = built.mesh.find("normal")->values;
  const auto& thickness = built.mesh.find("material_thickness")->values;
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_EQ(thickness[n + v], 2 * thickness[v]);
    EXPECT_NEAR(normal[3 * (n + v) + 2], normal[3 * v + 1], 1e-12);  // y goes to z
    EXPECT_NEAR(built.mesh.points[n + v][2], 2 * built.mesh.points[v][1], 1e-12);
  }
}

TEST(ScenePicture, FaultsNameTheLine) {
  for (const char* text :
       {"[[thing]]\nshape = \"builtin:spher\"\n", "[[thing]]\nshape = \"builtin:sphere\"\nrecipe = \"zebr\"\n",
        "[[thing]]\nshape = \"builtin:sphere\"\nmaterial = { color = \"blue\" }\n"})
    try {
      build_scene(parse_scene(text, "s.toml"), "", {});
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.where().file, "s.toml") << error.what();
      EXPECT_GT(error.where().line, 1) << error.what();
    }
}

TEST(ScenePicture, BuiltInScenesAreWellFormed) {
  const std::vector<std::string> names = scene_names();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) EXPECT_EQ(load_scene(name).name, name);
  EXPECT_THROW(load_scene("glasware"), Error);
}

}  // namespace
}  // namespace pelage
