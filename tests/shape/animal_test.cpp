#include "shape/animal.h"

#include <gtest/gtest.h>

#include <map>

#include "base/random.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

/// A place in the box around the animal.
Point random_place(std::uint64_t i) {
  return {-1.3 + 2.6 * uniform(1, 3 * i), 1.7 * uniform(1, 3 * i + 1), -0.5 + uniform(1, 3 * i + 2)};
}

TEST(AnimalField, GradientIsThatOfDifferences) {
  constexpr double h = 1e-5;
  int counted = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Point p = random_place(i);
    const FieldValue f = animal_field(p);
    if (std::abs(f.value) > 0.45) continue;  // the interesting places: near the surface
    ++counted;
    for (int d = 0; d < 3; ++d) {
      Point up = p, down = p;
      up[d] += h;
      down[d] -= h;
      const double difference = (animal_field(up).value - animal_field(down).value) / (2 * h);
      EXPECT_NEAR(f.gradient[d], difference, 1e-4) << "at " << p[0] << " " << p[1] << " " << p[2];
    }
  }
  EXPECT_GT(counted, 500);
}

TEST(Animal, StandsOnTheGroundAndLooksAlongX) {
  Point lower = {9, 9, 9}, upper = {-9, -9, -9};
  for (const Point& p : animal(5000).points)
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], p[d]);
      upper[d] = std::max(upper[d], p[d]);
    }
  EXPECT_NEAR(lower[1], 0, 0.01);
  EXPECT_GT(upper[0] - lower[0], upper[1] - lower[1]);
  EXPECT_GT(upper[1] - lower[1], upper[2] - lower[2]);
}

TEST(Animal, EnclosesTheVolumeWhereTheFieldIsNegative) {
  constexpr double spacing = 0.02;
  int inside = 0;
  for (double x = -1.3; x < 1.3; x += spacing)
    for (double y = -0.2; y < 1.7; y += spacing)
      for (double z = -0.6; z < 0.6; z += spacing) inside += animal_field({x, y, z}).value < 0;
  EXPECT_NEAR(testing::mesh_facts(animal(20000)).volume, inside * spacing * spacing * spacing, 0.003);
}

TEST(Animal, IsWellMeshedOnTheSurface) {
  for (std::size_t n : {500, 4000, 20000}) {
    SCOPED_TRACE(n);
    const TriangleMesh mesh = animal(n);
    for (const Point& p : mesh.points) {
      const FieldValue f = animal_field(p);
      EXPECT_LT(std::abs(f.value), 1e-10 * testing::vec(f.gradient).norm());
    }
    const testing::MeshFacts facts = testing::mesh_facts(mesh);
    std::map<int, double> share;
    for (int valence : facts.valences) share[valence] += 1.0 / static_cast<double>(mesh.points.size());
    EXPECT_GT(share[5] + share[6] + share[7], 0.99);
    EXPECT_GT(share[6], 0.7);
    EXPECT_LT(facts.longest_edge / facts.shortest_edge, 4);
  }
}

}  // namespace
}  // namespace pelage
