#include "render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "pelage/render.h"

namespace pelage {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

std::vector<Vector3f> cloud(float sx, float sy, float sz) {
  std::vector<Vector3f> points;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto u = [&](std::uint64_t k) { return static_cast<float>(uniform(k, i)) - 0.5F; };
    points.emplace_back(sx * u(0) + 5, sy * u(1), sz * u(2));
  }
  return points;
}

TEST(Camera, TheTighterPairOfMarginsIsMetExactly) {
  for (double aspect : {0.5, 1.0, 1.8})
    for (double azimuth : {0.0, 35.0, 250.0})
      for (double elevation : {-30.0, 0.0, 60.0})
        for (const auto& points : {cloud(1, 1, 1), cloud(4, 1, 1), cloud(1, 3, 0.1F)}) {
          const Camera camera = frame_points(points, azimuth, elevation, aspect, 0.1);
          Vector2f low(9, 9), high(-9, -9);
          for (const Vector3f& p : points) {
            low = low.cwiseMin(camera.project(p));
            high = high.cwiseMax(camera.project(p));
          }
          constexpr float inner = 0.8F;
          EXPECT_GT(low.minCoeff(), -inner - 1e-4F);
          EXPECT_LT(high.maxCoeff(), inner + 1e-4F);
          const int axis = high.x() > high.y() ? 0 : 1;
          EXPECT_NEAR(high[axis], inner, 1e-4F);
          EXPECT_NEAR(low[axis], -inner, 1e-4F);
        }
}

TEST(Camera, DirectionAndProjectionAreInverse) {
  const Camera camera = frame_points(cloud(1, 2, 3), 35, 14, 1.5, 0.05);
  for (float x : {-1.0F, 0.0F, 0.7F}) {
    const Vector2f back = camera.project(camera.position + 3 * camera.direction(x, -x / 2));
    EXPECT_NEAR(back.x(), x, 1e-5F);
    EXPECT_NEAR(back.y(), -x / 2, 1e-5F);
  }
}

TEST(Camera, AzimuthAndElevation) {
  const Camera front = frame_points(cloud(1, 1, 1), 0, 0, 1, 0.05),
               right = frame_points(cloud(1, 1, 1), 90, 0, 1, 0.05);
  EXPECT_LT((front.back - Vector3f::UnitZ()).norm(), 1e-6F);
  EXPECT_LT((right.back - Vector3f::UnitX()).norm(), 1e-6F);
  EXPECT_LT((front.up - Vector3f::UnitY()).norm(), 1e-6F);
}

TEST(Camera, PlacedWhereAFramingOneStandsItIsTheSame) {
  const Camera framing = frame_points(cloud(1, 2, 3), 35, 14, 0.7, 0.05, 40);
  const Camera placed = placed_camera(framing.position, -3 * framing.back, {0, 2, 0}, 0.7, 40);
  EXPECT_LT((placed.right - framing.right).norm(), 1e-5F);
  EXPECT_LT((placed.up - framing.up).norm(), 1e-5F);
  EXPECT_FLOAT_EQ(placed.tan_x, framing.tan_x);
  EXPECT_FLOAT_EQ(placed.tan_y, framing.tan_y);
}

TEST(Camera, LensesOf35MillimetreFilm) {
  EXPECT_NEAR(angle_of_lens(18), 90, 1e-9);       // half of 36 mm over 18 mm is 1
  EXPECT_NEAR(angle_of_lens(50), 39.5978, 1e-4);  // as lens tables have it
  EXPECT_NEAR(angle_of_lens(78), PictureOptions().angle, 0.05);
}

TEST(Camera, ATurntableShowsAllAndKeepsSizeAndPlace) {
  const std::vector<Vector3f> points = cloud(4, 1, 2);
  const Camera first = frame_points(swept_around(points, 0), 0, 14, 1, 0.05);
  for (const double azimuth : {33.0, 90.0, 222.5}) {
    const Camera camera = frame_points(swept_around(points, azimuth), azimuth, 14, 1, 0.05);
    for (const Vector3f& p : points) EXPECT_LT(camera.project(p).cwiseAbs().maxCoeff(), 0.9F + 1e-3F);
    const Vector3f middle(5, 0, 0);  // of the cloud, about: it stays where it is, as far away
    EXPECT_NEAR(camera.project(middle).x(), first.project(middle).x(), 0.02F);
    EXPECT_NEAR((camera.position - middle).norm(), (first.position - middle).norm(), 0.05F);
    EXPECT_NEAR(camera.position.y(), first.position.y(), 1e-4F);
  }
}

}  // namespace
}  // namespace pelage
