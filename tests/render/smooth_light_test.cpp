#include "render/smooth_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace pelage {
namespace {

using Eigen::Vector3f;

constexpr int side = 64, levels = 4;

Light light_of(float visible, float room) {
  Light light;
  light.lamp = {2 * visible, 2, visible, 1};
  light.room.setConstant(room);
  light.lamp_samples = light.room_samples = 1;
  return light;
}

/// Places of a plane, one for each pixel, with light_at_place(index).
template <class LightAtPlace>
LightGrid plane_of(const LightAtPlace& light_at_place, float stretch = 1) {
  LightGrid grid(side, side, 1, stretch);
  for (std::size_t i = 0; i < grid.lights.size(); ++i) grid.lights[i] = light_at_place(static_cast<int>(i));
  return grid;
}

void smooth(LightGrid& grid) {
  smooth_light(grid, levels, [](double) {});
}

TEST(SmoothLight, SamplesBecomeMeans) {
  Light light;
  light.lamp = {1, 4, 2, 8};
  light.room.setConstant(6);
  light.lamp_samples = 2, light.room_samples = 3;
  light.closeness.room = 1.5F;
  light.make_mean();
  EXPECT_EQ(light.visible_key(), 0.25F);
  EXPECT_EQ(light.lamp[Light::open_key], 2);
  EXPECT_EQ(light.room, Vector3f::Constant(2));
  EXPECT_EQ(light.closeness.room, 0.5F);
}

TEST(SmoothLight, EvenLightStaysAndPlacesWithoutStayWithout) {
  LightGrid grid = plane_of([](int i) { return i % 7 ? light_of(0.5F, -0.25F) : Light{}; });
  smooth(grid);
  for (std::size_t i = 0; i < grid.lights.size(); ++i) {
    EXPECT_EQ(grid.lights[i].traced(), i % 7 != 0);
    if (!grid.lights[i].traced()) continue;
    EXPECT_NEAR(grid.lights[i].room[1], -0.25F, 1e-6F);
    EXPECT_NEAR(grid.lights[i].visible_key(), 0.5F, 1e-6F);
  }
}

TEST(SmoothLight, NoiseFallsAndTheMeanStays) {
  double before = 0, after = 0, squares = 0;
  LightGrid grid =
      plane_of([](int i) { return light_of(1, static_cast<float>(uniform(1, static_cast<std::uint64_t>(i)))); });
  for (const Light& p : grid.lights) before += static_cast<double>(p.room[0]) / (side * side);
  smooth(grid);
  for (const Light& p : grid.lights) {
    const auto value = static_cast<double>(p.room[0]);
    after += value / (side * side);
    squares += (value - 0.5) * (value - 0.5) / (side * side);
  }
  EXPECT_NEAR(after, before, 0.005);
  // The weights of all levels but their bump have the variance 1/2 + 2 + 8 + 32 in each direction: a Gaussian of such a
  // width divides a deviation of 0.29 by 2 sqrt(pi * 42.5).
  EXPECT_LT(std::sqrt(squares), 2 * 0.29 / (2 * std::sqrt(3.14 * 42.5)));
}

TEST(SmoothLight, NearThingsKeepTheirShadowsSharp) {
  for (const bool lamp_is_near : {false, true}) {
    LightGrid grid = plane_of([](int i) { return i % side < side / 2 ? light_of(0, 0) : light_of(1, 1); });
    grid.closeness.assign(grid.lights.size(), {lamp_is_near ? 1 : 0.001F, lamp_is_near ? 0.001F : 1});
    smooth(grid);
    const Light& beside = grid.lights[side * side / 2 + side / 2 + 4];  // pixels from the edge
    const float near = lamp_is_near ? beside.visible_key() : beside.room[0],
                far = lamp_is_near ? beside.room[0] : beside.visible_key();
    EXPECT_NEAR(near, 1, 0.01F);
    EXPECT_LT(far, 0.9F);
  }
}

TEST(SmoothLight, NothingPassesFromOneSurfaceToAnother) {
  // Left a wall, right another one behind it, or one that turns away; dark and bright.
  for (const bool turned : {false, true}) {
    LightGrid grid(side, side, 1, 0);
    const auto right = [](std::size_t i) { return static_cast<int>(i) % side >= side / 2; };
    for (std::size_t i = 0; i < grid.lights.size(); ++i) {
      const auto x = static_cast<float>(static_cast<int>(i) % side), y = static_cast<float>(static_cast<int>(i) / side);
      grid.lights[i] = right(i) ? light_of(1, 0) : light_of(0, -0.5F);
      grid.guides[i] = {{x, y, right(i) && !turned ? -60.0F : 0.0F},
                        {right(i) && turned ? 1.0F : 0.0F, 0, right(i) && turned ? 0.0F : 1.0F}};
    }
    smooth(grid);
    for (std::size_t i = 0; i < grid.lights.size(); ++i) {
      EXPECT_NEAR(grid.lights[i].visible_key(), right(i) ? 1 : 0, 1e-5F);
      EXPECT_NEAR(grid.lights[i].visible_gloss(), right(i) ? 1 : 0, 1e-5F);
      EXPECT_NEAR(grid.lights[i].room[2], right(i) ? 0 : -0.5F, 1e-5F);
    }
  }
}

TEST(SmoothLight, ReachesNoFartherThanItSays) {
  LightGrid grid = plane_of([](int i) { return light_of(1, i == side * side / 2 + side / 2 ? 1 : 0); });
  smooth(grid);
  for (int x = light_reach(levels, 1); x < side / 2; ++x)
    EXPECT_EQ(grid.lights[static_cast<std::size_t>(side * side / 2 + side / 2 + x)].room[0], 0);
}

TEST(SmoothLight, FewRaysThatFindWhatIsNearTellTheirNeighbours) {
  // Of a row of places every fifth found a thing that is 10 pixels away; all rays of the room find it once.
  LightGrid grid = plane_of([](int i) {
    Light light = light_of(1, 0);
    light.lamp_samples = light.room_samples = 4;
    light.closeness = {i % 5 ? 0 : 0.1F, 0.1F};
    return light;
  });
  find_closeness(grid);
  const std::size_t middle = side * side / 2 + side / 2;
  for (std::size_t i = middle; i < middle + 10; ++i) {
    EXPECT_NEAR(grid.closeness[i].lamp, 0.1F, 1e-6F);
    EXPECT_NEAR(grid.closeness[i].room, 0.025F, 1e-6F);
  }
}

TEST(SmoothLight, ClosenessHasNoSteps) {
  LightGrid grid = plane_of([](int i) {
    Light light = light_of(1, 0);
    light.closeness = {i % side < side / 2 ? 0.0F : 0.1F, i % side < side / 2 ? 0.0F : 0.1F};
    return light;
  });
  find_closeness(grid);
  for (std::size_t i = side * side / 2 + 1; i < side * side / 2 + side; ++i) {
    EXPECT_LT(std::abs(grid.closeness[i].lamp - grid.closeness[i - 1].lamp), 0.08F);
    EXPECT_LT(std::abs(grid.closeness[i].room - grid.closeness[i - 1].room), 0.05F);
  }
}

TEST(SmoothLight, TheFewerPlacesShareLightTheMoreRaysTheyWant) {
  LightGrid even(side, side, 2, 1), stretched(side, side, 2, 4);
  std::uint32_t before = 0;
  for (const float distance : {1000.0F, 100.0F, 30.0F, 10.0F, 1.0F}) {
    even.closeness[0] = stretched.closeness[0] = {1 / distance, 0};
    const auto [lamp, room] = rays_wanted(even, 0, 4);
    EXPECT_GE(lamp, before);
    EXPECT_LE(lamp, 64);
    EXPECT_EQ(room, 4);
    EXPECT_GE(rays_wanted(stretched, 0, 4)[0], lamp);
    before = lamp;
  }
  EXPECT_EQ(before, 64);
}

TEST(SmoothLight, PixelsTakeTheirLightFromPlacesOfTheirSurface) {
  // One place for 2 x 2 pixels, brighter by 1 from column to column; a slope, and another surface on the right.
  LightGrid grid(side, side, 2, 0);
  for (std::size_t i = 0; i < grid.lights.size(); ++i) {
    const auto x = static_cast<float>(static_cast<int>(i) % grid.columns),
               y = static_cast<float>(static_cast<int>(i) / grid.columns);
    const bool right = x >= 16;
    grid.lights[i] = light_of(1, right ? 100 : x);
    grid.guides[i] = {{2 * x, 2 * y, right ? -90.0F : 0.0F}, Vector3f::UnitZ()};
  }
  for (int x = 0; x < 28; ++x) {
    const LightGuide guide{{static_cast<float>(x), 20, 0}, Vector3f::UnitZ()};
    EXPECT_NEAR(light_at(grid, x, 20, &guide).room[0], static_cast<float>(x) / 2, 1e-4F);
  }
  for (int x = 28; x < 33; ++x) {  // also where the pixel's own places are of the other surface
    const LightGuide guide{{static_cast<float>(x), 20, 0}, Vector3f::UnitZ()};
    const Light light = light_at(grid, x, 20, &guide);
    ASSERT_TRUE(light.traced());
    EXPECT_LE(light.room[0], 15);
  }
  const LightGuide elsewhere{{50, 20, 900}, Vector3f::UnitZ()};
  EXPECT_FALSE(light_at(grid, 50, 20, &elsewhere).traced());
}

}  // namespace
}  // namespace pelage
