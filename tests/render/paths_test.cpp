#include "render/paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "shape/generators.h"

namespace pelage {
namespace {

using Eigen::Vector3f;

/// A ball of radius 1/4 on the floor, with these values in all places.
TriangleMesh ball(const std::vector<std::pair<Channel, double>>& channels, double grey) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=10242");
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (Point& p : mesh.points)
    for (std::size_t k = 0; k < 3; ++k) {
      normal.values.push_back(p[k]);
      p[k] = p[k] / 4 + (k == 1 ? 0.25 : 0);
    }
  const std::size_t n = mesh.points.size();
  mesh.attributes = {normal, {"color", 3, Domain::vertex, std::vector<double>(3 * n, grey)}};
  for (const auto& [channel, value] : channels)
    mesh.set({std::string(kind_of(channel).attribute), 1, Domain::vertex, std::vector<double>(n, value)});
  return mesh;
}

struct Table {
  explicit Table(const TriangleMesh& mesh) : scene(mesh, points_of(mesh), Eigen::Matrix3f::Identity()) {}
  static std::vector<Vector3f> points_of(const TriangleMesh& mesh) {
    std::vector<Vector3f> points;
    for (const Point& p : mesh.points) points.push_back(Eigen::Map<const Eigen::Vector3d>(p.data()).cast<float>());
    return points;
  }
  Studio studio{Vector3f::UnitZ(), Vector3f(0.8F, 0.8F, 0.8F)};
  RayScene scene;
  Paths paths{scene, studio};
};

/// Means of `count` samples each.
template <class Sample>
std::vector<double> means(std::uint32_t count, const Sample& sample) {
  std::vector<double> result;
  for (std::uint32_t k = 0; k < 256; ++k) {
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      PathNumbers random(k * count + i);
      sum += double{sample(random)[0]} / count;
    }
    result.push_back(sum);
  }
  return result;
}

double deviation(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double sum = 0;
  for (const double x : values) sum += (x - mean) * (x - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

const Vector3f origin(0.1F, 0.35F, 3), forward(0, 0, -1);

/// Noise falls at least with the root of the samples: sixteen times as many leave a quarter of it.
TEST(Paths, NoiseFallsWithSamples) {
  const Table table(ball({{Channel::roughness, 0.4}, {Channel::metalness, 1}}, 0.8));
  const auto point = table.scene.meet(origin, forward);
  ASSERT_TRUE(point);
  const Reflection surface(point->color, table.scene.finish(point->hit));
  const auto mirrored = [&](PathNumbers& random) { return table.paths.mirrored(*point, surface, forward, random); };
  const double few = deviation(means(4, mirrored)), more = deviation(means(16, mirrored)),
               many = deviation(means(64, mirrored));
  EXPECT_GT(few, 0);
  EXPECT_LT(more, 0.6 * few);
  EXPECT_LT(many, few / 4);
}

/// Both ways to the lamp give its light, and so does either alone: a rough and a smooth surface that mirror it.
TEST(Paths, MirrorTheLampAsItIs) {
  const Table table(ball({{Channel::roughness, 0.15}, {Channel::metalness, 1}}, 1));
  // Seen so that the middle of the lamp is mirrored.
  const Vector3f normal = (table.studio.key_points()[0].direction + Vector3f::UnitZ()).normalized();
  const Vector3f place = Vector3f(0, 0.25F, 0) + normal / 4;
  const auto point = table.scene.meet(place + Vector3f::UnitZ(), forward);
  ASSERT_TRUE(point);
  const Reflection surface(Vector3f::Ones(), table.scene.finish(point->hit));
  const auto mirrored = [&](PathNumbers& random) { return table.paths.mirrored(*point, surface, forward, random); };
  const std::vector<double> all = means(64, mirrored);
  const double mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  const Vector3f up = table.studio.key_points()[0].direction;
  EXPECT_NEAR(mean, (table.studio.lamp(up) + table.studio.surroundings(up))[0], 0.05 * mean);
}

/// White glass before a white sheet all around loses and adds nothing, whether thin or solid, clear or frosted.
TEST(Paths, GlassKeepsTheEnergy) {
  for (const double thickness : {0.0, 1.0})
    for (const double roughness : {0.0, 0.5}) {
      const Table table(
          ball({{Channel::transmission, 1}, {Channel::thickness, thickness}, {Channel::roughness, roughness}}, 1));
      const Paths paths(table.scene, table.studio, Vector3f::Ones());
      const auto point = table.scene.meet(origin, forward);
      ASSERT_TRUE(point);
      const Vector3f behind(1, 1, 1);
      const auto sent = [&](PathNumbers& random) {
        return paths.through(*point, table.scene.finish(point->hit), forward, behind, random);
      };
      const std::vector<double> all = means(16, sent);
      EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()), 1, 0.005)
          << thickness << " " << roughness;
    }
}

/// Nor does a white ball, by what it mirrors and what it scatters.
TEST(Paths, WhiteThingsDisappearInEvenLight) {
  for (const double metalness : {0.0, 1.0}) {
    const Table table(ball({{Channel::roughness, 0.6}, {Channel::metalness, metalness}}, 1));
    const Paths paths(table.scene, table.studio, Vector3f::Ones());
    const auto point = table.scene.meet(origin, forward);
    ASSERT_TRUE(point);
    const Reflection surface(Vector3f::Ones(), table.scene.finish(point->hit));
    const std::vector<double> all =
        means(16, [&](PathNumbers& random) { return paths.mirrored(*point, surface, forward, random); });
    const double mirrored = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
    EXPECT_NEAR(mirrored + surface.scattered(-point->normal.dot(forward))[0], 1, 0.01) << metalness;
  }
}

/// Glass of the index 1.5 sends a ray through the middle of a ball straight on, in its colour to the power of the way
/// over the thickness.
TEST(Paths, GlassTakesColourOnItsWay) {
  const Table table(ball({{Channel::transmission, 1}, {Channel::thickness, 0.25}, {Channel::roughness, 0}}, 0.5));
  const Paths paths(table.scene, table.studio, Vector3f::Ones());
  const Vector3f start(0, 0.25F, 3), behind(1, 1, 1);
  const auto point = table.scene.meet(start, forward);
  ASSERT_TRUE(point);
  const std::vector<double> all = means(64, [&](PathNumbers& random) {
    return paths.through(*point, table.scene.finish(point->hit), forward, behind, random);
  });
  // Reflected at the front, and light that has crossed the ball 1, 2, 3, ... times (twice its thickness each time).
  const double r = 0.04, once = 0.25;
  double expected = r, inside = 1 - r;
  for (int crossing = 0; crossing < 20; ++crossing) {
    inside *= once;
    expected += inside * (1 - r);
    inside *= r;
  }
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()), expected, 0.01);
}

/// What is half there shows half of what is behind it; a ray passes two walls of a ball.
TEST(Paths, OpacityIsAShare) {
  const Table table(ball({{Channel::opacity, 0}, {Channel::emission, 1}}, 1));
  const auto point = table.scene.meet(origin, forward);
  ASSERT_TRUE(point);
  const Vector3f behind(0.25F, 0.5F, 0.75F);
  PathNumbers random(1);
  EXPECT_EQ(table.paths.through(*point, table.scene.finish(point->hit), forward, behind, random), behind);
  EXPECT_FALSE(table.scene.occluded(origin, forward));
  EXPECT_TRUE(std::isinf(table.scene.distance(origin, forward)));
}

TEST(RayScene, BlocksAsMuchAsItIsOpaque) {
  const Table table(ball({{Channel::opacity, 0.7}}, 1));
  int blocked = 0;
  constexpr std::uint32_t count = 4000;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto [x, y] = scrambled_sobol(k, 1);
    blocked += table.scene.occluded({0.3F * x - 0.15F, 0.1F + 0.3F * y, 3}, forward);
  }
  EXPECT_NEAR(blocked / static_cast<double>(count), 1 - 0.3 * 0.3, 0.02);
}

}  // namespace
}  // namespace pelage
