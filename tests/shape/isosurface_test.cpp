#include "shape/isosurface.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

constexpr Point lower = {-1.6, -1.5, -0.7}, upper = {1.55, 1.5, 0.75};

FieldValue torus(const Point& p) {
  const double ring = std::hypot(p[0], p[1]), out = ring - 1, distance = std::hypot(out, p[2]);
  return {distance - 0.4, {out / distance * p[0] / ring, out / distance * p[1] / ring, p[2] / distance}};
}

TEST(Isosurface, OfATorusIsATorus) {
  for (double spacing : {0.2, 0.1, 0.05}) {
    const testing::MeshFacts facts = testing::mesh_facts(isosurface(torus, lower, upper, spacing));
    EXPECT_TRUE(facts.closed);
    EXPECT_EQ(facts.euler, 0);
    const double volume = 2 * std::numbers::pi * std::numbers::pi * 0.16;
    EXPECT_NEAR(facts.volume, volume, 5 * spacing * spacing * volume);  // linear interpolation: second order
  }
}

TEST(Isosurface, IsClosedAndManifoldForAnyValues) {
  // Independent random signs at the lattice's nodes meet every case of a tetrahedron and every ambiguity of a cube.
  auto noise = [](const Point& p) -> FieldValue {
    const bool border = std::abs(p[0]) > 0.95 || std::abs(p[1]) > 0.95 || std::abs(p[2]) > 0.95;
    std::uint64_t key = 7;
    for (double x : p) key = hash(key, static_cast<std::uint64_t>(std::lround(10 * x) + 100));
    return {border ? 1 : uniform(key, 0) - 0.5, {0, 0, 0}};
  };
  const testing::MeshFacts facts = testing::mesh_facts(isosurface(noise, {-1, -1, -1}, {1, 1, 1}, 0.1));
  EXPECT_TRUE(facts.closed);
  EXPECT_GT(facts.volume, 0);
}

TEST(ProjectToSurface, ReachesTheNearestPointOfADistance) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double u = 6.28 * uniform(2, 3 * i), v = 6.28 * uniform(2, 3 * i + 1), r = 0.2 + 0.4 * uniform(2, 3 * i + 2);
    auto at = [&](double radius) {
      return Point{(1 + radius * std::cos(v)) * std::cos(u), (1 + radius * std::cos(v)) * std::sin(u),
                   radius * std::sin(v)};
    };
    const Point found = project_to_surface(torus, at(r), 0.05);
    EXPECT_LT((testing::vec(found) - testing::vec(at(0.4))).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace pelage
