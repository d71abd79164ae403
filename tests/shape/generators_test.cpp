#include "shape/generators.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "pelage/error.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

using std::numbers::pi;
using testing::mesh_facts;
using testing::MeshFacts;
using testing::vec;

struct Expected {
  int euler;
  bool closed;
  double area, volume, tolerance;  ///< of the smooth shape, relative
  double angle;                    ///< degrees: no triangle has a smaller one
};

TEST(Generators, HaveTheTopologyMeasureAndAnglesOfTheirShape) {
  // The knot's volume and area follow from Pappus' theorem with the length of its centre line: 2 pi times the mean
  // of sqrt(4 (2 + cos 3t)^2 + 9), 31.8986.
  constexpr double knot_length = 31.8986;
  const std::map<std::string, Expected> shapes = {
      {"sphere", {2, true, 4 * pi, 4 * pi / 3, 0.005, 48}},
      {"torus", {0, true, 4 * pi * pi * 0.4, 2 * pi * pi * 0.16, 0.01, 35}},
      {"knot", {0, true, pi * knot_length, pi * 0.25 * knot_length, 0.01, 25}},
      {"cube", {2, true, 6, 1, 1e-12, 44.999}},
      {"plane", {1, false, 1, 0, 1e-12, 44.999}},
      {"animal", {2, true, 5.374, 0.5571, 0.01, 30}}};  // area and volume at 200,000 vertices
  for (const auto& [name, expected] : shapes) {
    SCOPED_TRACE(name);
    for (int n : {2000, 10000}) {
      const TriangleMesh mesh = builtin_shape("builtin:" + name + "?n=" + std::to_string(n));
      const MeshFacts facts = mesh_facts(mesh);
      EXPECT_NEAR(static_cast<double>(mesh.points.size()), n, 0.2 * n);
      EXPECT_EQ(facts.euler, expected.euler);
      EXPECT_EQ(facts.closed, expected.closed);
      EXPECT_GE(facts.smallest_angle, expected.angle);
      const double tolerance = expected.tolerance * 10000 / n + 1e-12;  // inscribed triangles: an error of order 1/n
      EXPECT_NEAR(facts.area, expected.area, tolerance * expected.area);
      EXPECT_NEAR(facts.volume, expected.volume, tolerance * expected.volume);
    }
  }
}

TEST(Generators, RegularShapesHaveRegularValences) {
  for (const char* name : {"torus", "knot"})
    for (int valence : mesh_facts(builtin_shape(std::string("builtin:") + name + "?n=1500")).valences)
      EXPECT_EQ(valence, 6) << name;
  std::map<int, int> sphere;
  for (int valence : mesh_facts(builtin_shape("builtin:sphere?n=2562")).valences) ++sphere[valence];
  EXPECT_EQ(sphere, (std::map<int, int>{{5, 12}, {6, 2550}}));
}

TEST(Generators, VerticesLieOnTheExactSurface) {
  for (const Point& p : builtin_shape("builtin:sphere").points) EXPECT_NEAR(vec(p).norm(), 1, 1e-15);
  for (const Point& p : builtin_shape("builtin:torus").points)
    EXPECT_NEAR(std::hypot(std::hypot(p[0], p[1]) - 1, p[2]), 0.4, 1e-15);
  for (const Point& p : builtin_shape("builtin:cube").points)
    EXPECT_EQ(std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}), 0.5);
  for (const Point& p : builtin_shape("builtin:knot?n=400").points) {
    double nearest = 1e300;  // to the centre line, finely sampled: an error of (step / 2)^2 / (2 radius) = 3e-5
    for (int i = 0; i < 4000; ++i) {
      const double t = 2 * pi * i / 4000, ring = 2 + std::cos(3 * t);
      nearest = std::min(
          nearest, (vec(p) - Eigen::Vector3d(ring * std::cos(2 * t), ring * std::sin(2 * t), std::sin(3 * t))).norm());
    }
    EXPECT_NEAR(nearest, 0.5, 5e-5);
  }
}

TEST(Generators, GiveTheSameBitsEveryTime) {
  for (const std::string& name : builtin_shape_names()) {
    const TriangleMesh one = builtin_shape("builtin:" + name + "?n=3000");
    const TriangleMesh two = builtin_shape("builtin:" + name + "?n=3000");
    EXPECT_EQ(one.points, two.points) << name;
    EXPECT_EQ(one.triangles, two.triangles) << name;
  }
}

TEST(Generators, SayWhatIsWrongWithASpecification) {
  auto fault = [](const std::string& spec) -> std::string {
    try {
      builtin_shape(spec);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::usage);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(fault("builtin:shpere").find("did you mean \"sphere\"?"), std::string::npos);
  EXPECT_NE(fault("builtin:zzz").find("known: animal, cube, knot, plane, sphere, torus"), std::string::npos);
  EXPECT_NE(fault("builtin:torus?count=5").find("unknown parameter"), std::string::npos);
  for (const char* count : {"", "x", "12x", "-5", "99", "1e9", "99999999999999"})
    EXPECT_NE(fault(std::string("builtin:torus?n=") + count).find("whole number from 100"), std::string::npos) << count;
}

}  // namespace
}  // namespace pelage
