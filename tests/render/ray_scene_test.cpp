#include "render/ray_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pelage/error.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using Eigen::Vector3f;

std::vector<Vector3f> points_of(const TriangleMesh& mesh) {
  std::vector<Vector3f> points;
  for (const Point& p : mesh.points) points.push_back(Eigen::Map<const Eigen::Vector3d>(p.data()).cast<float>());
  return points;
}

/// The unit sphere with its exact normals, coloured by position.
TriangleMesh sphere() {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=2000");
  Attribute normal{"normal", 3, Domain::vertex, {}}, color{"color", 3, Domain::vertex, {}};
  for (const Point& p : mesh.points)
    for (double x : p) {
      normal.values.push_back(x);
      color.values.push_back((x + 1) / 2);
    }
  mesh.attributes = {normal, color};
  return mesh;
}

TEST(RayScene, HitsTheSphereWhereItIs) {
  const TriangleMesh mesh = sphere();
  const RayScene scene(mesh, points_of(mesh), Eigen::Matrix3f::Identity());
  for (int i = -9; i <= 9; ++i) {
    const Vector3f origin(0.1F * static_cast<float>(i), 0.13F, 5), direction(0, 0, -1);
    const auto hit = scene.intersect(origin, direction);
    const float d2 = 1 - origin.x() * origin.x() - 0.13F * 0.13F;
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->position.z(), std::sqrt(d2), 0.01F);
    EXPECT_LT((hit->normal - hit->position).norm(), 0.01F);
    EXPECT_LT((2 * hit->color - Vector3f::Ones() - hit->position).norm(), 0.01F);
    EXPECT_GT(hit->lifted.norm(), hit->position.norm());
    EXPECT_NEAR(hit->lifted.norm(), 1, 0.005F);  // back on the round sphere
    EXPECT_TRUE(scene.occluded(origin, direction));
  }
  EXPECT_FALSE(scene.intersect({1.2F, 0, 5}, {0, 0, -1}));
  EXPECT_FALSE(scene.occluded({1.2F, 0, 5}, {0, 0, -1}));
}

TEST(RayScene, NormalsFaceTheRayAlsoFromInside) {
  const TriangleMesh mesh = sphere();
  const RayScene scene(mesh, points_of(mesh), Eigen::Matrix3f::Identity());
  const auto hit = scene.intersect({0, 0, 0}, Vector3f(1, 2, 3).normalized());
  ASSERT_TRUE(hit);
  EXPECT_LT(hit->normal.dot(Vector3f(1, 2, 3)), 0);
  EXPECT_LT(hit->lifted.norm(), hit->position.norm());
}

TEST(RayScene, NoRaySlipsThroughAClosedSurface) {
  const TriangleMesh mesh = sphere();
  const RayScene scene(mesh, points_of(mesh), Eigen::Matrix3f::Identity());
  const std::vector<Vector3f> points = points_of(mesh);
  for (const Triangle& t : mesh.triangles)  // along the edges, the weakest places
    EXPECT_TRUE(scene.occluded({0, 0, 0}, (points[t[0]] + points[t[1]]).normalized()));
}

TEST(RayScene, ABundleFindsWhatItsRaysFind) {
  const TriangleMesh mesh = sphere();
  const RayScene scene(mesh, points_of(mesh), Eigen::Matrix3f::Identity());
  const Vector3f origin(0, 0, 5);
  std::vector<Vector3f> directions;
  for (int i = 0; i < 11; ++i) directions.push_back(Vector3f(0.03F * static_cast<float>(i), 0.01F, -1).normalized());
  std::vector<Hit> hits(directions.size());
  scene.intersect(origin, directions, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const auto alone = scene.intersect(origin, directions[i]);
    ASSERT_EQ(alone.has_value(), hits[i].triangle != Hit::nothing);
    const float distance = scene.distance(origin, directions[i]);
    EXPECT_EQ(std::isinf(distance), !alone);
    if (!alone) continue;
    const SurfacePoint point = scene.surface_point(scene.skin(directions[i], hits[i]), hits[i]);
    EXPECT_LT((point.position - alone->position).norm(), 1e-5F);
    EXPECT_NEAR((point.position - origin).norm(), distance, 1e-5F);
  }
}

TEST(RayScene, BuildingCanBeCancelled) {
  const TriangleMesh mesh = sphere();
  EXPECT_THROW(RayScene(mesh, points_of(mesh), Eigen::Matrix3f::Identity(), [](double) { return false; }), Error);
}

TEST(RayScene, RotationTurnsTheNormals) {
  TriangleMesh mesh = sphere();
  Eigen::Matrix3f rotation;
  rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  std::vector<Vector3f> points = points_of(mesh);
  for (Vector3f& p : points) p = rotation * p;
  const RayScene scene(mesh, points, rotation);
  const auto hit = scene.intersect({0.3F, 0.5F, 5}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_LT((hit->normal - hit->position).norm(), 0.01F);
}

}  // namespace
}  // namespace pelage
