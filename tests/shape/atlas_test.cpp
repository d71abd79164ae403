// Patches that are sewn along their sides.

#include "shape/atlas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "pelage/error.h"
#include "shape/topology.h"

namespace pelage {
namespace {

using std::numbers::pi;
using Place = std::function<Point(double u, double v)>;

Atlas::Patch patch(const std::string& name, std::int32_t nu, std::int32_t nv, const Place& place) {
  Atlas::Patch p;
  p.name = name;
  p.grid.count = {nu, nv, 1};
  for (std::int32_t j = 0; j < nv; ++j)
    for (std::int32_t i = 0; i < nu; ++i)
      p.grid.points.push_back(place(static_cast<double>(i) / (nu - 1), static_cast<double>(j) / (nv - 1)));
  return p;
}

/// Faces in orientations of all kinds: axes exchanged, sides reversed.
std::vector<Atlas::Patch> cube(std::int32_t n) {
  std::vector<Atlas::Patch> patches;
  for (std::size_t d = 0; d < 3; ++d)
    for (const double side : {-0.5, 0.5})
      patches.push_back(patch("face" + std::to_string(patches.size()), n, n, [&](double u, double v) {
        Point p{};
        p[d] = side;
        p[(d + 1) % 3] = u - 0.5;
        p[(d + 2) % 3] = 0.5 - v;
        return p;
      }));
  return patches;
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto& [a, b, c] = t;
    const Point &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    sum += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
  }
  return sum / 6;
}

/// Three patches in a corner; every side is shared, and the outside is outside.
TEST(Atlas, ACubeIsClosed) {
  const std::int32_t n = 5;
  const Atlas atlas = sew(cube(n));
  EXPECT_EQ(atlas.nodes, 6 * (n - 1) * (n - 1) + 2);
  EXPECT_FALSE(atlas.one_sided);
  const TriangleMesh mesh = mesh_of(atlas);
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  for (const Index twin : topology.twin) EXPECT_GE(twin, 0);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
}

TEST(Atlas, ATubeClosesUponItselfAndAMoebiusBandHasOneSide) {
  const auto band = [](double turns) {
    return std::vector{patch("band", 25, 5, [=](double u, double v) {
      const double width = v - 0.5, angle = 2 * pi * u, twist = pi * turns * u;
      const double r = 1 + width * std::cos(twist);
      return Point{r * std::cos(angle), r * std::sin(angle), width * std::sin(twist)};
    })};
  };
  for (const double turns : {0.0, 1.0, 2.0}) {
    const Atlas atlas = sew(band(turns));
    EXPECT_EQ(atlas.nodes, 24 * 5);
    EXPECT_EQ(atlas.one_sided, turns == 1.0);
  }
}

/// A side without length is one node.
TEST(Atlas, APoleIsOneNode) {
  const Atlas atlas = sew({patch("globe", 17, 9, [](double u, double v) {
    const double a = 2 * pi * u, b = pi * v;
    return Point{std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)};
  })});
  EXPECT_EQ(atlas.nodes, 16 * 7 + 2);
  const TriangleMesh mesh = mesh_of(atlas);
  EXPECT_EQ(mesh.triangles.size(), 2U * 16 * 6 + 2U * 16);
  EXPECT_GT(volume(mesh), 0);
}

TEST(Atlas, ValuesGoBackToThePatches) {
  const Atlas atlas = sew(cube(4));
  const TriangleMesh mesh = mesh_of(atlas);
  std::vector<double> coordinates;
  for (const Point& p : mesh.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  for (const Atlas::Patch& p : atlas.patches) {
    const std::vector<double> own = on_patch(p, coordinates, 3);
    for (std::size_t v = 0; v < p.grid.points.size(); ++v)
      for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(own[3 * v + d], p.grid.points[v][d], 1e-12);
  }
}

std::string refusal(std::vector<Atlas::Patch> patches) {
  try {
    sew(std::move(patches));
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

Atlas::Patch square(const std::string& name, std::int32_t nu, std::int32_t nv, const Point& from, const Point& u,
                    const Point& v) {
  return patch(name, nu, nv, [&](double s, double t) {
    return Point{from[0] + s * u[0] + t * v[0], from[1] + s * u[1] + t * v[1], from[2] + s * u[2] + t * v[2]};
  });
}

TEST(Atlas, SidesThatDoNotMatchAreNamed) {
  const Atlas::Patch left = square("left", 5, 5, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(refusal({left, square("right", 5, 5, {1, 0, 0}, {1, 0, 0}, {0, 1, 0})}), "");
  EXPECT_NE(refusal({left, square("right", 5, 7, {1, 0, 0}, {1, 0, 0}, {0, 1, 0})})
                .find("left.east and right.west run along each other but do not match: 5 and 7 nodes"),
            std::string::npos);
  EXPECT_NE(refusal({left, square("right", 5, 9, {1, 0, 0}, {1, 0, 0}, {0, 2, 0})})
                .find("left.east and right.west meet along a part"),
            std::string::npos);
  EXPECT_NE(refusal({left, square("right", 5, 5, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                     square("fin", 5, 5, {1, 0, 0}, {0, 0, 1}, {0, 1, 0})})
                .find("left, right and fin share an edge"),
            std::string::npos);
}

}  // namespace
}  // namespace pelage
