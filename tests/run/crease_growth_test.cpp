// Coats on shapes with creases, while these are faired.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "catalog/bind.h"
#include "fair/noisy.h"
#include "pelage/error.h"
#include "run/run.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using testing::with_noise;
using Growth = Run;  // in a test, Run is a function of its own

Recipe creased_recipe(double size) {
  Recipe recipe;
  recipe.stages[0].size = Given<Length>{{size, Length::Unit::world}, {}};
  recipe.stages[0].crease = Given<double>{40, {}};
  return recipe;
}

double half_side(const TriangleMesh& cube) {
  double most = 0;
  for (const Point& p : cube.points) most = std::max(most, p[0]);
  return most;
}

/// How far a point is from the nearest edge of the cube.
double from_edges(const Point& p, double half) {
  Point beside;
  for (std::size_t k = 0; k < 3; ++k) beside[k] = std::abs(std::abs(p[k]) - half);
  std::ranges::sort(beside);
  return std::hypot(beside[0], beside[1]);
}

/// Of the vertices of the run's mesh that lie on creases, from the edges of the cube, in edges of the shape: the mean.
double distance_of_creases(const Growth& run, double half, double edge) {
  const Topology& t = run.world().topology();
  const std::vector<Point>& points = run.world().space().control();
  std::vector<char> on_line(points.size(), false);
  for (std::size_t h = 0; h < t.twin.size(); ++h)
    if (t.sharp(static_cast<Index>(h))) on_line[static_cast<std::size_t>(t.origin(static_cast<Index>(h)))] = true;
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < points.size(); ++v)
    if (on_line[v]) sum += from_edges(points[v], half), ++count;
  EXPECT_GT(count, 100);
  return sum / count / edge;
}

/// The creases are found on the noisy cube nearly as on the true one, and lie on its edges when the noise is off.
TEST(CreaseGrowth, FairedEdgesAreStraight) {
  const TriangleMesh cube = builtin_shape("builtin:cube?n=2402");
  const double half = half_side(cube), edge = testing::mean_edge(cube);
  Recipe recipe = creased_recipe(half / 2);
  recipe.motion.fair = {"guided", {}};
  recipe.motion.every = 1;
  const Program program = make_program(recipe, with_noise(cube, 0.1));
  const Creases truth = make_program(creased_recipe(half / 2), cube).creases;
  const Topology t = make_topology(cube.points.size(), cube.triangles);
  for (std::size_t h = 0; h < t.twin.size(); ++h) {
    const auto e = static_cast<std::size_t>(t.edge[h]);
    if (truth.edge[e] == program.creases.edge[e]) continue;
    Point beside = cube.points[static_cast<std::size_t>(t.origin(static_cast<Index>(h)))];
    for (double& x : beside) x = half - std::abs(x);
    EXPECT_LT(length(beside), 2.1 * edge);  // from a corner: fairing may leave a facet there
  }
  Growth run(program);
  const double before = distance_of_creases(run, half, edge);
  while (run.world().surface()->moving() && !run.done()) run.advance(1);
  const double after = distance_of_creases(run, half, edge);
  ::testing::Test::RecordProperty("before", std::to_string(before));
  ::testing::Test::RecordProperty("after", std::to_string(after));
  EXPECT_GT(before, 0.05);
  EXPECT_LT(after, 0.05);
}

TEST(CreaseGrowth, AreOfSmoothSurfacesAlone) {
  const TriangleMesh cube = builtin_shape("builtin:cube?n=150");
  Recipe recipe = creased_recipe(1);
  recipe.stages[0].method.value = "linear";
  EXPECT_THROW(make_program(recipe, cube), Error);
  recipe.stages[0].method.value = "loop";
  EXPECT_TRUE(make_program(recipe, cube).creases.any());
  recipe.stages[0].crease->value = 95;
  const Program none = make_program(recipe, cube);
  EXPECT_FALSE(none.creases.any());
  EXPECT_EQ(none.warnings.size(), 1);
}

/// A coat with creases does not go on as one without.
TEST(CreaseGrowth, CheckpointsKnowTheCreases) {
  const TriangleMesh cube = builtin_shape("builtin:cube?n=602");
  const double half = half_side(cube);
  Recipe recipe = creased_recipe(half / 2);
  Growth whole(make_program(recipe, cube)), sliced(make_program(recipe, cube)), resumed(make_program(recipe, cube));
  whole.advance(6);
  sliced.advance(3);
  const std::string state = sliced.checkpoint();
  resumed.restore(state);
  resumed.advance(3);
  EXPECT_EQ(whole.checkpoint(), resumed.checkpoint());
  recipe.stages[0].crease.reset();
  Growth smooth(make_program(recipe, cube));
  EXPECT_THROW(smooth.restore(state), Error);
}

}  // namespace
}  // namespace pelage
