#include "render/path_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace pelage {
namespace {

using Eigen::Vector3f;

/// Even in [0, 1).
float random(std::uint64_t i, std::uint64_t k) { return static_cast<float>(hash(i, k) >> 40) * 0x1p-24F; }

/// A wall that faces the camera; `light(x)` with noise of a standard deviation, as means of so many samples.
PathGrid wall(int side, float deviation, std::uint32_t samples, const std::function<float(int)>& light) {
  PathGrid grid(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto i = static_cast<std::size_t>(y * side + x);
      PathSum sum;
      const float spread = deviation * std::sqrt(12.0F * static_cast<float>(samples));
      for (std::uint32_t k = 0; k < samples; ++k)
        sum.add(Vector3f::Constant(light(x) + spread * (random(i, k) - 0.5F)));
      grid.lights[i].mean = sum.mean(), grid.lights[i].variance = sum.variance();
      grid.guides[i].surface.position = {static_cast<float>(x), static_cast<float>(y), 0};
      grid.guides[i].surface.normal = Vector3f::UnitZ();
      grid.guides[i].seen = true;
    }
  return grid;
}

/// Root mean square of the difference, over the columns from `left` on.
float noise(const PathGrid& grid, int left, int right, const std::function<float(int)>& light) {
  float sum = 0, count = 0;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = left; x < right; ++x, ++count)
      sum += std::pow(grid.lights[static_cast<std::size_t>(y * grid.columns + x)].mean[0] - light(x), 2.0F);
  return std::sqrt(sum / count);
}

const auto silent = [](double) {};

TEST(PathLight, VarianceIsThatOfTheMean) {
  double squares = 0, variances = 0;
  constexpr int means = 20000;
  for (int i = 0; i < means; ++i) {
    PathSum sum;
    for (std::uint64_t k = 0; k < 4; ++k) sum.add(Vector3f::Constant(random(static_cast<std::uint64_t>(i), k)));
    squares += std::pow(static_cast<double>(sum.mean()[0]) - 0.5, 2) / means;
    variances += static_cast<double>(sum.variance()) / means;
  }
  EXPECT_NEAR(squares, 1.0 / 12 / 4, 5e-4);
  EXPECT_NEAR(variances, squares, 5e-4);
}

/// Noise without a picture goes; its mean stays.
TEST(PathLight, EvenLightLosesItsNoise) {
  const auto even = [](int) { return 0.5F; };
  PathGrid grid = wall(64, 0.1F, 4, even);
  const float before = noise(grid, 0, 64, even);
  EXPECT_NEAR(before, 0.1F, 0.005F);
  smooth_paths(grid, 5, silent);
  EXPECT_LT(noise(grid, 0, 64, even), before / 8);
  double mean = 0;
  for (const PathLight& light : grid.lights) mean += static_cast<double>(light.mean[0]) / 64 / 64;
  EXPECT_NEAR(mean, 0.5, 0.005);
}

/// A step of much more than the noise stays where it is, and what has no noise as it is.
TEST(PathLight, EdgesStay) {
  const auto step = [](int x) { return x < 32 ? 0.2F : 1.0F; };
  PathGrid grid = wall(64, 0.04F, 16, step);
  smooth_paths(grid, 5, silent);
  EXPECT_LT(noise(grid, 28, 36, step), 0.02F);
  const auto waves = [](int x) { return 0.5F + 0.01F * std::sin(static_cast<float>(x)); };
  PathGrid clear = wall(64, 0, 4, waves);
  smooth_paths(clear, 5, silent);
  EXPECT_LT(noise(clear, 0, 64, waves), 1e-4F);
}

/// Of two materials side by side, or two surfaces, neither takes the other's light, however noisy both are.
TEST(PathLight, SurfacesAndMaterialsAreKeptApart) {
  const auto step = [](int x) { return x < 32 ? 0.4F : 0.6F; };
  for (const bool material : {true, false}) {
    PathGrid grid = wall(64, 0.2F, 4, step);
    for (std::size_t i = 0; i < grid.guides.size(); ++i)
      if (i % 64 >= 32) {
        if (material)
          grid.guides[i].finish.metalness = 1;
        else
          grid.guides[i].surface.normal = Vector3f::UnitX();
      }
    smooth_paths(grid, 5, silent);
    EXPECT_LT(noise(grid, 26, 38, step), 0.05F) << material;
  }
}

/// A single path that was lucky is shared by its neighbours, and not seen.
TEST(PathLight, OneBrightSampleIsShared) {
  const auto even = [](int) { return 0.5F; };
  PathGrid grid = wall(64, 0.05F, 4, even);
  PathSum sum;
  for (const float sample : {0.5F, 0.4F, 8.0F, 0.6F}) sum.add(Vector3f::Constant(sample));
  PathLight& bright = grid.lights[32 * 64 + 32];
  bright.mean = sum.mean(), bright.variance = sum.variance();
  smooth_paths(grid, 5, silent);
  for (const PathLight& light : grid.lights) EXPECT_LT(light.mean[0], 0.75F);
}

}  // namespace
}  // namespace pelage
