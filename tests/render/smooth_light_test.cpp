#include "render/smooth_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace pelage {
namespace {

constexpr int side = 64, levels = 4;

FloorLight floor_of(float value) {
  FloorLight light;
  for (std::size_t k = 0; k < 3; ++k) light.light[k] = 4 * value;
  light.count = 4;
  return light;
}

CoatLight coat_of(float visible, float room) {
  CoatLight light;
  light.light = {2 * visible, 2, visible, 1, 4 * room, 4 * room, 4 * room, 0};
  light.count = 4;
  return light;
}

template <class Light>
void smooth(std::vector<Light>& pixels, const std::vector<LightGuide>& guides) {
  smooth_light(pixels, guides, side, 1, levels, [](double) {});
}

TEST(SmoothLight, EvenLightStaysAndPixelsWithoutSamplesStayWithout) {
  std::vector<FloorLight> pixels(side * side, floor_of(-0.25F));
  for (int i = 0; i < side * side; i += 7) pixels[static_cast<std::size_t>(i)] = {};
  smooth(pixels, {});
  for (int i = 0; i < side * side; ++i) {
    const FloorLight& p = pixels[static_cast<std::size_t>(i)];
    EXPECT_EQ(p.count > 0, i % 7 != 0);
    if (p.count <= 0) continue;
    EXPECT_NEAR(p.change()[1], -0.25F, 1e-6F);
  }
}

TEST(SmoothLight, NoiseFallsAndTheMeanStays) {
  std::vector<FloorLight> pixels;
  double before = 0, after = 0, squares = 0;
  for (int i = 0; i < side * side; ++i) {
    pixels.push_back(floor_of(static_cast<float>(uniform(1, static_cast<std::uint64_t>(i)))));
    before += static_cast<double>(pixels.back().change()[0]) / (side * side);
  }
  smooth(pixels, {});
  for (const FloorLight& p : pixels) {
    const auto value = static_cast<double>(p.change()[0]);
    after += value / (side * side);
    squares += (value - 0.5) * (value - 0.5) / (side * side);
  }
  EXPECT_NEAR(after, before, 0.005);
  // The weights of all levels but their bump have the variance 1/2 + 2 + 8 + 32 in each direction: a Gaussian of such a
  // width divides a deviation of 0.29 by 2 sqrt(pi * 42.5).
  EXPECT_LT(std::sqrt(squares), 2 * 0.29 / (2 * std::sqrt(3.14 * 42.5)));
}

TEST(SmoothLight, NearThingsKeepTheirShadowsSharp) {
  std::vector<FloorLight> far, near;
  for (int i = 0; i < side * side; ++i) {
    far.push_back(floor_of(i % side < side / 2 ? 0 : 1));
    near.push_back(far.back());
    near.back().closeness = 1;
    far.back().closeness = 0.01F;
  }
  smooth(far, {});
  smooth(near, {});
  const std::size_t beside = side * side / 2 + side / 2 + 4;  // pixels from the edge
  EXPECT_NEAR(near[beside].change()[0], 1, 0.01F);
  EXPECT_LT(far[beside].change()[0], 0.9F);
}

TEST(SmoothLight, NothingPassesFromOneSurfaceToAnother) {
  // Left a wall, right another one behind it, or one that turns away; dark and bright.
  for (const bool turned : {false, true}) {
    std::vector<CoatLight> pixels;
    std::vector<LightGuide> guides;
    for (int i = 0; i < side * side; ++i) {
      const bool right = i % side >= side / 2;
      const auto x = static_cast<float>(i % side), y = static_cast<float>(i / side);
      pixels.push_back(right ? coat_of(1, 0) : coat_of(0, -0.5F));
      guides.push_back({{x, y, right && !turned ? -60.0F : 0.0F},
                        {right && turned ? 1.0F : 0.0F, 0, right && turned ? 0.0F : 1.0F}});
    }
    smooth(pixels, guides);
    for (int i = 0; i < side * side; ++i) {
      const bool right = i % side >= side / 2;
      const CoatLight& p = pixels[static_cast<std::size_t>(i)];
      EXPECT_NEAR(p.visible_key(), right ? 1 : 0, 1e-5F);
      EXPECT_NEAR(p.visible_gloss(), right ? 1 : 0, 1e-5F);
      EXPECT_NEAR(p.room_light()[2], right ? 0 : -0.5F, 1e-5F);
    }
  }
}

TEST(SmoothLight, ReachesNoFartherThanItSays) {
  std::vector<FloorLight> pixels(side * side, floor_of(0));
  pixels[side * side / 2 + side / 2] = floor_of(1);
  smooth(pixels, {});
  for (int x = light_reach(levels); x < side / 2; ++x)
    EXPECT_EQ(pixels[static_cast<std::size_t>(side * side / 2 + side / 2 + x)].change()[0], 0);
}

}  // namespace
}  // namespace pelage
