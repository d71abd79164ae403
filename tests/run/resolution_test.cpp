#include "run/resolution.h"

#include <gtest/gtest.h>

#include "catalog/resolve.h"
#include "run/run.h"
#include "shape/generators.h"

namespace pelage {
namespace {

TEST(Resolution, LargestWaveNumberIsThatOfAnEvenMesh) {
  Recipe recipe;
  recipe.stage.size = Given<Length>{{0.2, true}, {}};
  const Run run(resolve(recipe, builtin_shape("builtin:sphere?n=1002")));
  const double edge = prevailing_edge(run.operators().discretisation().topology.triangles, run.operators().control());
  const double expected = largest_k2_of_coarsest_mesh(6 * edge);
  EXPECT_NEAR(run.operators().largest_k2(), expected, 0.1 * expected);
}

}  // namespace
}  // namespace pelage
