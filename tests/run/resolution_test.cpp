#include "run/resolution.h"

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "run/run.h"
#include "shape/generators.h"
#include "shape/refine.h"

namespace pelage {
namespace {

Run start(const std::string& shape) {  // in a test, Run is a member of the test
  Recipe recipe;
  recipe.stages[0].method.value = "loop";
  recipe.stages[0].size = Given<Length>{{0.2}, {}};
  return Run(make_program(recipe, builtin_shape(shape)));
}

TEST(Resolution, LargestWaveNumberIsThatOfAnEvenMesh) {
  const auto run = start("builtin:sphere?n=1002");
  const double edge = prevailing_edge(run.world().topology().triangles, run.space().control());
  const double expected = largest_k2_of_coarsest_mesh(6 * edge, 6);
  EXPECT_NEAR(largest_k2(*run.system().mass, *run.space().stiffness()), expected, 0.1 * expected);
}

}  // namespace
}  // namespace pelage
