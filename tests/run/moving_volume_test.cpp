// Volumes whose surface is faired or grows.

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/bind.h"
#include "catalog/models.h"
#include "discretise/tet_space.h"
#include "fair/noisy.h"
#include "look/dress.h"
#include "pelage/error.h"
#include "run/run.h"
#include "shape/generators.h"
#include "shape/locate.h"
#include "shape/tet_mesh.h"
#include "shape/tet_quality.h"
#include "shape/vectors.h"
#include "solid/fill.h"

namespace pelage {
namespace {

using testing::with_noise;
using Growth = Run;  // in a test, Run is a function of its own

Recipe solid_recipe(double size, const std::string& more = "") {
  Recipe recipe = parse_recipe("[stage]\nmodel = \"turing\"\n" + more, "solid.toml");
  recipe.stages[0].size = Given<Length>{{size, Length::Unit::world}, {}};
  return recipe;
}

Recipe fairing_recipe(double size, std::int64_t every) {
  Recipe recipe = solid_recipe(size);
  recipe.motion.fair = {"guided", {}};
  recipe.motion.every = every;
  return recipe;
}

TriangleMesh noisy_sphere() { return with_noise(builtin_shape("builtin:sphere?n=362"), 0.2); }

/// In tetrahedra larger than those that a run takes by itself.
Program in_volume(const Recipe& recipe, const TriangleMesh& surface, double edge) {
  TetMesh volume = fill(surface, edge, 1'000'000).volume;
  volume.surface = std::make_shared<const TriangleMesh>(surface);
  TriangleMesh mesh = mesh_of(volume);
  return bind_plan(plan(recipe), std::make_shared<const NodeShape>(std::move(volume)), std::move(mesh), {});
}

const TetMesh& volume_of_run(const Growth& run) { return *as<TetMesh>(run.fields().nodes); }

TEST(HarmonicVolume, TakesTheInsideAlongAsTheSurfaceIsTakenLinearly) {
  const auto surface = std::make_shared<const TriangleMesh>(builtin_shape("builtin:torus"));
  const auto volume = std::make_shared<const TetMesh>(fill(*surface, 0.2, 1'000'000).volume);
  const HarmonicVolume inside(volume, surface, TetSpace(*volume).stiffness());
  const auto mapped = [](std::vector<Point> points) {
    for (Point& p : points)
      p = {1.1 * p[0] + 0.2 * p[1] + 3, 0.9 * p[1] - 0.1 * p[2], 1.3 * p[2] + 0.3 * p[0] - 0.1 * p[1] - 2};
    return points;
  };
  const std::vector<Point> expected = mapped(volume->points), found = inside.points(mapped(surface->points));
  double error = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::size_t d = 0; d < 3; ++d) error = std::max(error, std::abs(found[k][d] - expected[k][d]));
  EXPECT_LT(error, 1e-4);  // the solve ends at 1e-5 of residuals
}

struct Ball {
  std::shared_ptr<const TriangleMesh> surface =
      std::make_shared<const TriangleMesh>(builtin_shape("builtin:sphere?n=500"));
  std::shared_ptr<const TetMesh> volume = std::make_shared<const TetMesh>(fill(*surface, 0.3, 1'000'000).volume);
  HarmonicVolume inside{volume, surface, TetSpace(*volume).stiffness()};
};

/// One vertex goes to the other side of the ball: what would be turned inside out follows what is around it.
TEST(HarmonicVolume, NothingIsTurnedInsideOut) {
  const Ball ball;
  std::vector<Point> points = ball.surface->points;
  points[7] = {-points[7][0], -points[7][1], -points[7][2]};
  const std::vector<Point> found = ball.inside.points(points);
  std::size_t moved = 0;
  for (std::size_t k = 0; k < found.size(); ++k) moved += length(difference(found[k], ball.volume->points[k])) > 0.1;
  EXPECT_GT(moved, 0U);
  for (const Tetrahedron& t : ball.volume->tets) {
    const auto at = [&](std::size_t c) { return found[static_cast<std::size_t>(t[c])]; };
    EXPECT_GT(signed_volume(at(0), at(1), at(2), at(3)), 0);
  }
}

TEST(HarmonicVolume, ASurfaceThatTurnsInsideOutIsRefused) {
  const Ball ball;
  std::vector<Point> mirrored = ball.surface->points;
  for (Point& p : mirrored) p[0] = -p[0];
  EXPECT_THROW(ball.inside.points(mirrored), Error);
}

double largest_distance(const std::vector<Point>& from, const TriangleMesh& to) {
  const SurfaceWalk walk(make_topology(to.points.size(), to.triangles), to.points);
  double largest = 0;
  for (const Point& p : from) {
    const Eigen::Vector3d x(p[0], p[1], p[2]);
    largest = std::max(largest, (walk.point(walk.search(x, Eigen::Vector3d::Zero())) - x).norm());
  }
  return largest;
}

TEST(MovingVolume, TheSkinEndsOnTheFairedSurface) {
  const TriangleMesh noisy = noisy_sphere(), faired = fair(noisy).mesh;
  Growth run(in_volume(fairing_recipe(0.9, 2), noisy, 0.15));
  TetMesh volume = volume_of_run(run);
  const double noise = largest_distance(skin_mesh(volume).points, faired);
  while (run.world().surface()->moving() && !run.done()) run.advance(1);
  EXPECT_EQ(run.world().surface()->points(), faired.points);
  const std::vector<Point> shown = dress(run.fields(), Look{}).points;
  EXPECT_TRUE(std::equal(faired.points.begin(), faired.points.end(), shown.begin()));
  volume.points = run.fields().points;
  EXPECT_EQ(run.space().control(), volume.points);
  EXPECT_GT(noise, 0.02);
  EXPECT_LT(largest_distance(skin_mesh(volume).points, faired), 1e-6);
  const auto [least, most] = dihedral_angles(volume);
  EXPECT_GT(least, 5);
  EXPECT_LT(most, 170);
}

TEST(MovingVolume, AVolumeOfAFileIsFairedAtItsSkin) {
  TetMesh volume = fill(noisy_sphere(), 0.25, 1'000'000).volume;
  const TriangleMesh skin = skin_mesh(volume);
  Recipe recipe = fairing_recipe(2, 1);
  TriangleMesh mesh = mesh_of(volume);
  Growth run(bind_plan(plan(recipe), std::make_shared<const NodeShape>(std::move(volume)), std::move(mesh), {}));
  while (run.world().surface()->moving() && !run.done()) run.advance(1);
  EXPECT_EQ(run.world().surface()->points(), fair(skin).mesh.points);
}

TEST(MovingVolume, SlicesAndCheckpointsKeepTheBits) {
  for (const char* mode : {"texture", "physical"}) {
    Recipe recipe = fairing_recipe(2, 3);
    recipe.motion.mode.value = mode;
    recipe.motion.growth = 1e-4;
    const auto start = [&] { return Growth(in_volume(recipe, noisy_sphere(), 0.25)); };
    Growth whole = start(), resumed = start(), sliced = start();
    whole.advance(7);
    sliced.advance(4);  // between two moves
    resumed.restore(sliced.checkpoint());
    resumed.advance(3);
    EXPECT_TRUE(whole.checkpoint() == resumed.checkpoint()) << mode;
    EXPECT_EQ(whole.amounts(), resumed.amounts()) << mode;
    EXPECT_EQ(whole.fields().points, resumed.fields().points) << mode;
  }
}

/// A source and a decay, du/dt = a - b u, in a ball of radius exp(g t): the amount m obeys m' = a V(t) - b m with
/// V = V(0) exp(3 g t) when amounts ride along.
double amount_error(double step) {
  constexpr double a = 0.3, b = 0.2, g = 0.03, until = 8, u0 = 2;
  Recipe recipe = solid_recipe(2, "step = " + std::to_string(step) + "\nuntil = 8\nstepper = \"sbdf2\"\n");
  recipe.motion.growth = g;
  recipe.motion.mode.value = "physical";
  recipe.motion.every = 1;
  Program program = in_volume(recipe, builtin_shape("builtin:sphere?n=362"), 0.3);
  program.stages[0].model =
      compile(parse_model("name = \"source\"\ntitle = \"source and decay\"\ncite = \"none\"\n"
                          "[species.u]\nrate = \"0.3 - 0.2*u\"\ndiffusion = \"0.01\"\ninitial = \"2\"\n",
                          "source.toml"));
  program.stages[0].stationary = 0;
  Growth run(std::move(program));
  TetMesh volume = volume_of_run(run);
  const double before = pelage::volume_of(volume);
  run.advance(100000);
  volume.points = run.fields().points;
  EXPECT_NEAR(pelage::volume_of(volume) / before, std::exp(3 * g * until), 1e-9);
  const double c = a / (b + 3 * g);
  return std::abs(run.amounts()[0] / (before * (c * std::exp(3 * g * until) + (u0 - c) * std::exp(-b * until))) - 1);
}

TEST(MovingVolume, AmountsInAGrowingBallFollowTheory) {
  const double coarse = amount_error(0.2), fine = amount_error(0.1);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(coarse / fine, 3.4);  // second order in time
}

}  // namespace
}  // namespace pelage
