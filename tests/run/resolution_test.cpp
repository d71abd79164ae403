#include "run/resolution.h"

#include <gtest/gtest.h>

#include "catalog/resolve.h"
#include "run/run.h"
#include "shape/generators.h"

namespace pelage {
namespace {

Run start(const std::string& shape) {  // in a test, Run is a member of the test
  Recipe recipe;
  recipe.stages[0].size = Given<Length>{{0.2, true}, {}};
  return Run(resolve(recipe, builtin_shape(shape)));
}

TEST(Resolution, LargestWaveNumberIsThatOfAnEvenMesh) {
  const auto run = start("builtin:sphere?n=1002");
  const double edge = prevailing_edge(run.operators().discretisation().topology.triangles, run.operators().control());
  const double expected = largest_k2_of_coarsest_mesh(6 * edge, 6);
  EXPECT_NEAR(run.operators().largest_k2(), expected, 0.1 * expected);
}

}  // namespace
}  // namespace pelage
