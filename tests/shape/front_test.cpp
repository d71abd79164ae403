#include "shape/front.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "pelage/io.h"
#include "shape/generators.h"

namespace pelage {
namespace {

/// Turned around y, from +z towards +x.
TriangleMesh turned(TriangleMesh mesh, double degrees) {
  const double a = degrees * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  for (Point& p : mesh.points) p = {c * p[0] + s * p[2], p[1], c * p[2] - s * p[0]};
  return mesh;
}

double difference(double a, double b) { return std::abs(std::remainder(a - b, 360)); }

TEST(Front, OfTheAnimalIsWhereItsHeadIs) {
  const TriangleMesh cub = builtin_shape("builtin:animal?n=4000");
  const std::optional<double> front = front_of(cub, UpAxis::y);
  ASSERT_TRUE(front);
  double high = -1e9;
  Point top{};
  for (const Point& p : cub.points)
    if (p[1] > high) high = p[1], top = p;
  const double a = *front * std::numbers::pi / 180;
  EXPECT_GT(top[0] * std::sin(a) + top[2] * std::cos(a), 0);
  for (const double by : {90.0, 180.0, 210.0, 35.0}) {
    const auto after = front_of(turned(cub, by), UpAxis::y);
    ASSERT_TRUE(after) << by;
    EXPECT_LE(difference(*after, *front + by), 5) << by;
  }
}

TEST(Front, IsTheSameForEveryUnitPlaceAndAxis) {
  const TriangleMesh cub = builtin_shape("builtin:animal?n=4000");
  TriangleMesh moved = cub, lying = cub;
  for (Point& p : moved.points) p = {4096 + 64 * p[0], 64 * p[1] - 512, 64 * p[2]};
  for (Point& p : lying.points) p = {p[0], -p[2], p[1]};
  EXPECT_EQ(front_of(moved, UpAxis::y), front_of(cub, UpAxis::y));
  EXPECT_EQ(front_of(lying, UpAxis::z), front_of(cub, UpAxis::y));
}

TEST(Front, OfWhatHasNoneIsNotGuessed) {
  for (const char* name : {"sphere", "torus", "knot", "cube", "plane"})
    EXPECT_FALSE(front_of(builtin_shape(std::string("builtin:") + name + "?n=2000"), UpAxis::y)) << name;
  EXPECT_FALSE(front_of({}, UpAxis::y));
  TriangleMesh point;
  point.points = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  point.triangles = {{0, 1, 2}};
  EXPECT_FALSE(front_of(point, UpAxis::y));
}

/// A head on a pole ahead of its feet, or above them: a lamp has no face.
TriangleMesh head_and_feet(double ahead) {
  TriangleMesh mesh;
  const auto add = [&](double x, double y, double z, double wide, double tall, double length) {
    const TriangleMesh cube = builtin_shape("builtin:cube?n=200");
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (const Point& p : cube.points) mesh.points.push_back({x + wide * p[0], y + tall * p[1], z + length * p[2]});
    for (const Triangle& t : cube.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  add(0, 1, 0, 0.4, 0.4, 1.6);
  add(0, 1.7, ahead, 0.3, 0.4, 0.4);
  for (const double side : {-0.15, 0.15})
    for (const double z : {-0.8, 0.3}) add(side, 0.4, z, 0.1, 0.8, 0.1);
  return mesh;
}

TEST(Front, IsWhereTheHeadStandsOut) {
  EXPECT_EQ(front_of(head_and_feet(0.7), UpAxis::y), 0);
  EXPECT_EQ(front_of(turned(head_and_feet(0.7), 180), UpAxis::y), 180);
  EXPECT_FALSE(front_of(head_and_feet(-0.7), UpAxis::y));  // the feet would stand before the head
}

/// What people see in pictures of these.
TEST(Front, OfKnownAnimals) {
  const std::filesystem::path folder = PELAGE_SHARED_MESHES;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "shared/meshes is not beside the checkout";
  for (const auto& [file, front] : {std::pair{"spot_829.obj", 180.0},
                                    {"cow_2904.off", 90.0},
                                    {"koala_3560.obj", 0.0},
                                    {"human_man_6890.obj", 0.0}}) {
    const auto found = front_of(load_shape(folder / file), UpAxis::y);
    ASSERT_TRUE(found) << file;
    EXPECT_LE(difference(*found, front), 5) << file;
  }
  for (const char* file : {"camelhead_11381.off", "fandisk_6475.off", "rockerarm_10044.off", "teapot_1202.obj"})
    EXPECT_FALSE(front_of(load_shape(folder / file), UpAxis::y)) << file;
}

}  // namespace
}  // namespace pelage
