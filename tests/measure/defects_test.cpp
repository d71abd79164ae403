#include "measure/defects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "measure/slopes.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using Vector3 = Eigen::Vector3d;

/// Half turns of the lines along a field of vectors.
std::vector<int> turns(const TriangleMesh& mesh, const std::function<Vector3(const Point&)>& line) {
  std::vector<Eigen::Matrix3d> tensors;
  for (const Point& p : mesh.points) {
    const Vector3 v = line(p);
    tensors.push_back(v * v.transpose());
  }
  return half_turns(mesh, tensors, area_normals(mesh));
}

int sum(const std::vector<int>& turns) { return std::accumulate(turns.begin(), turns.end(), 0); }
/// Triangles with some further than that from the origin.
int count_beyond(double radius, const TriangleMesh& mesh, const std::vector<int>& turns) {
  int n = 0;
  for (std::size_t f = 0; f < turns.size(); ++f) {
    const Point& p = mesh.points[mesh.triangles[f][0]];
    n += turns[f] != 0 && std::hypot(p[0], p[1]) > radius;
  }
  return n;
}
int count(const std::vector<int>& turns) {
  return static_cast<int>(std::count_if(turns.begin(), turns.end(), [](int t) { return t != 0; }));
}

TriangleMesh square(int n) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.push_back({2.0 * i / n - 0.97, 2.0 * j / n - 0.98, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j, b = a + 1, c = b + n + 1, d = a + n + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

/// Lines at the angle q phi make 2 q half turns around the origin.
TEST(Defects, DisclinationsOfThePlane) {
  for (const double q : {0.5, -0.5, 1.0, -1.0, 1.5}) {
    const TriangleMesh mesh = square(20);
    const auto around = turns(mesh, [q](const Point& p) {
      const double angle = q * std::atan2(p[1], p[0]) + 0.3;
      return Vector3{std::cos(angle), std::sin(angle), 0};
    });
    EXPECT_EQ(sum(around), static_cast<int>(2 * q)) << q;
    EXPECT_EQ(count_beyond(0.3, mesh, around), 0) << q;  // three edges
  }
}

TEST(Defects, ParallelLinesHaveNone) {
  EXPECT_EQ(count(turns(square(10), [](const Point&) { return Vector3{0.3, 0.8, 0}; })), 0);
}

/// Twice Euler's characteristic, whatever the field.
TEST(Defects, OnClosedSurfacesTheyKnowEuler) {
  const auto wild = [](const Point& p) {
    return Vector3{std::sin(9 * p[1] + 1), std::cos(7 * p[2]), std::sin(8 * p[0] - 5 * p[1])};
  };
  EXPECT_EQ(sum(turns(builtin_shape("builtin:sphere?n=2562"), wild)), 4);
  EXPECT_EQ(sum(turns(builtin_shape("builtin:animal?n=3000"), wild)), 4);
  EXPECT_EQ(sum(turns(builtin_shape("builtin:torus?n=2000"), wild)), 0);
}

/// Where triangles are so large that the turn of the surface itself is a half turn.
TEST(Defects, OnAnOctahedronTheyKnowEuler) {
  const TriangleMesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
                          {},
                          {},
                          {}};
  for (const double turn : {0.1, 0.4, 0.7, 1.1})
    EXPECT_EQ(sum(turns(mesh,
                        [&](const Point& p) {
                          return Vector3{std::sin(turn + p[1]), std::cos(3 * turn + p[2]), std::sin(5 * turn - p[0])};
                        })),
              4)
        << turn;
}

/// Meridians meet at the poles, which are two half turns each.
TEST(Defects, MeridiansOfASphere) {
  const auto around = turns(builtin_shape("builtin:sphere?n=2562"), [](const Point& p) {
    return Vector3{-p[0] * p[2], -p[1] * p[2], 1 - p[2] * p[2]};
  });
  EXPECT_EQ(sum(around), 4);
  EXPECT_LE(count(around), 4);
  for (const int t : around) EXPECT_GE(t, 0);
}

}  // namespace
}  // namespace pelage
