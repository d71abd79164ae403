// Witkin and Kass 1991, figure 2: stripes wrapped around a vase are as many at its neck as at its belly; those that
// grow on it are as wide.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "catalog/bind.h"
#include "catalog/scenes.h"
#include "run/run.h"
#include "shape/turned.h"

namespace pelage {
namespace {

using VaseRun = Run;  // in a test, Run is a function of its own

VaseRun grown(const SceneThing& thing) {
  Recipe recipe = *thing.recipe;
  recipe.quality = {"draft", {}};
  recipe.stages[0].size->value.value *= 1.6;
  VaseRun run(make_program(recipe, turned_shape(thing.turned, 4000)));
  while (!run.done()) run.advance(1000);
  return run;
}

/// Stripes on the way around the vase at a height, between the sides of the sheet.
int stripes_around(const VaseRun& run, double height) {
  constexpr int bins = 90;
  const Vector p = run.space().node_values() * run.coefficients()[1],
               q = run.space().node_values() * run.coefficients()[0];
  const auto& position = run.system().sampling->position;
  std::vector<double> sum(bins, 0);
  for (std::size_t v = 0; v < position.size(); ++v) {
    const Point& x = position[v];
    if (std::abs(x[1] - height) > 0.05 || std::hypot(x[0], x[2]) < 0.15) continue;
    const auto i = static_cast<Eigen::Index>(v);
    sum[static_cast<std::size_t>((std::atan2(x[2], x[0]) / std::numbers::pi + 1) * 0.4999 * bins)] += p[i] - q[i];
  }
  int stripes = 0;
  for (std::size_t k = 0; k < bins; ++k) stripes += sum[k] > 0 && sum[(k + bins - 1) % bins] <= 0;
  return stripes;
}

TEST(Distortion, IsInWhatIsWrappedAroundAndNotInWhatGrows) {
  constexpr double belly = 0.5, neck = 1.62;  // radii 0.70 and 0.19
  const Scene scene = load_scene("distortion");
  const VaseRun wrapped = grown(scene.things.at(0)), on_vase = grown(scene.things.at(1));
  const auto ratio = [](const VaseRun& run) {
    return stripes_around(run, belly) / static_cast<double>(stripes_around(run, neck));
  };
  EXPECT_NEAR(ratio(wrapped), 1, 0.35);
  EXPECT_NEAR(ratio(on_vase), 0.7 / 0.19, 1.2);
  EXPECT_GT(stripes_around(wrapped, belly), 5);
}

}  // namespace
}  // namespace pelage
