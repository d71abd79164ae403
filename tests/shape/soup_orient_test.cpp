#include "shape/soup_orient.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "shape/generators.h"
#include "shape/vectors.h"
#include "support/soups.h"

namespace pelage {
namespace {

Point normal_of(const TriangleMesh& mesh, std::size_t f) {
  const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(mesh.triangles[f][k])]; };
  return unit(cross(difference(at(1), at(0)), difference(at(2), at(0))));
}

/// Every part by chance; its corners say where they are.
TriangleMesh turned_at_random(TriangleMesh mesh, double share) {
  Attribute x{"x", 1, Domain::corner, {}};
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    if (uniform(1, f) < share) std::swap(mesh.triangles[f][0], mesh.triangles[f][2]);
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t v : t) x.values.push_back(mesh.points[static_cast<std::size_t>(v)][0]);
  mesh.set(x);
  return mesh;
}

/// Over cracks, T-junctions and folds all agree with most of them, and what the corners say comes along.
TEST(OrientSoup, GivesAllOneSide) {
  for (const TriangleMesh& whole : {brick_wall(6, 1), six_squares(), square_with_t_junctions()}) {
    TriangleMesh soup = turned_at_random(whole, 0.3);
    const std::size_t turned = orient_soup(soup);
    EXPECT_GT(turned, soup.triangles.size() / 8);
    EXPECT_LT(turned, soup.triangles.size() / 2);
    for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
      EXPECT_GT(dot(normal_of(soup, f), normal_of(whole, f)), 0.99) << f;
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(soup.find("x")->values[3 * f + k], soup.points[static_cast<std::size_t>(soup.triangles[f][k])][0]);
    }
  }
}

TEST(OrientSoup, LeavesAloneWhatAgrees) {
  TriangleMesh animal = builtin_shape("builtin:animal?n=3000"), plane = builtin_shape("builtin:plane?n=100");
  for (TriangleMesh* mesh : {&animal, &plane}) EXPECT_EQ(orient_soup(*mesh), 0u);
  TriangleMesh far = square_with_t_junctions();  // parts that do not meet
  add_square(far, {0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  EXPECT_EQ(orient_soup(far), 0u);
}

}  // namespace
}  // namespace pelage
