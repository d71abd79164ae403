#include "fair/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pelage/error.h"
#include "shape/generators.h"

namespace pelage {
namespace {

TEST(Compare, AMeshWithItselfIsZero) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=1000");
  const Comparison c = compare(mesh, mesh);
  ASSERT_TRUE(c.normals);
  EXPECT_LT(c.normals->quantile95, 1e-5);
  EXPECT_EQ(c.normals->flipped, 0U);
  EXPECT_LT(c.largest_distance, 1e-12);
  EXPECT_EQ(c.volume_change, 0);
}

TEST(Compare, ATurnedMeshIsOffByTheAngle) {
  const TriangleMesh flat = builtin_shape("builtin:plane?n=400");
  TriangleMesh turned = flat;
  const double angle = 0.3;
  for (Point& p : turned.points)
    p = {p[0], std::cos(angle) * p[1] - std::sin(angle) * p[2], std::sin(angle) * p[1] + std::cos(angle) * p[2]};
  EXPECT_NEAR(compare(turned, flat).normals->mean, angle * 180 / M_PI, 1e-9);
  for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_FALSE(compare(turned, flat).normals);
}

TEST(Compare, ALargerSphereIsOffByTheDifferenceOfTheRadii) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=10242");
  TriangleMesh larger = sphere;
  for (Point& p : larger.points)
    for (double& x : p) x *= 1.1;
  const Comparison c = compare(larger, sphere);
  const double diagonal = 2 * std::sqrt(3.0);
  EXPECT_NEAR(c.distance * diagonal, 0.1, 1e-3);
  EXPECT_NEAR(c.volume_change, std::pow(1.1, 3) - 1, 1e-9);
  EXPECT_LT(c.normals->mean, 1e-5);
}

TEST(Compare, EmptyMeshesAreRefused) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=162");
  EXPECT_THROW(compare({}, sphere), Error);
  EXPECT_THROW(compare(sphere, {}), Error);
}

}  // namespace
}  // namespace pelage
