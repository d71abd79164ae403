// Single charts: Tutte's embedding, borders that meet themselves, and the way to least distortion.

#include "unwrap/flatten.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "shape/generators.h"
#include "unwrap/outline.h"
#include "unwrap/overlap.h"
#include "unwrap/stretch.h"

namespace pelage {
namespace {

/// The caps of a sphere whose normals lean from the axis by less than `angle`.
Chart cap(const LinkedFaces& faces, double angle) {
  std::vector<std::int32_t> source;
  for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
    double z = 0;
    for (const std::int32_t v : faces.triangles[t]) z += faces.points[v][2] / 3 / faces.scale;
    if (z > std::cos(angle)) source.push_back(static_cast<std::int32_t>(t));
  }
  return make_chart(faces, source, [](std::int32_t) { return true; });
}

LinkedFaces sphere(int n) {
  std::vector<Finding> findings;
  return link_faces(polygons_of(builtin_shape("builtin:sphere?n=" + std::to_string(n))), findings);
}

TEST(Flatten, CapsOfASphereStretchNoMoreThanLambertsMap) {
  const LinkedFaces faces = sphere(10000);
  for (const double degrees : {30.0, 60.0, 90.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    Chart chart = cap(faces, angle);
    ASSERT_TRUE(is_disc(chart));
    ASSERT_TRUE(flatten(faces, chart));
    // Lambert's azimuthal map has the singular values c and 1 / c, c^2 = (1 + cos) / 2 even over the area.
    const double m = (1 + std::cos(angle)) / 2;
    const double lambert = std::sqrt(((1 - m * m) / 2 - std::log(m)) / (2 * (1 - m)));
    EXPECT_LT(chart.stretch, lambert) << degrees;
    EXPECT_GT(chart.stretch, 1 + 0.3 * (lambert - 1)) << degrees;
    EXPECT_FALSE(border_meets_itself(chart));
  }
}

TEST(Flatten, TheResultIsAMinimum) {
  const LinkedFaces faces = sphere(1000);
  Chart chart = cap(faces, 1);
  ASSERT_TRUE(flatten(faces, chart));
  const auto energy = [&](const Chart& c) {
    double sum = 0;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      std::array<Point, 3> p;
      std::array<Eigen::Vector2d, 3> u;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = faces.points[faces.triangles[c.source[t]][k]];
        u[k] = Eigen::Vector2d(c.uv[c.triangles[t][k]].data());
      }
      const RestTriangle rest = rest_triangle(p);
      const Eigen::Matrix2d j = rest.derivative(u);
      sum += rest.area * (j.squaredNorm() + j.inverse().squaredNorm());
    }
    return sum;
  };
  const double least = energy(chart);
  for (std::size_t v = 0; v < chart.uv.size(); v += 17)
    for (const double shift : {-2e-3, 2e-3})
      for (std::size_t k = 0; k < 2; ++k) {
        Chart moved = chart;
        moved.uv[v][k] += shift;
        EXPECT_GT(energy(moved), least);
      }
}

TEST(Flatten, EmbeddingsAreConvexAndTurnNothing) {
  const LinkedFaces faces = sphere(600);
  std::vector<std::int32_t> all(faces.triangles.size() - 1);  // a sphere with one triangle left out
  std::iota(all.begin(), all.end(), 0);
  Chart chart = make_chart(faces, all, [](std::int32_t) { return true; });
  ASSERT_TRUE(is_disc(chart));
  embed(faces, chart);
  double sum = 0;
  for (const Triangle& t : chart.triangles) {
    const double area = area_of({chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]});
    EXPECT_GT(area, 0);
    sum += area;
  }
  EXPECT_NEAR(sum / area_of(convex_hull(chart.uv)), 1, 1e-6);
}

TEST(Flatten, WhatIsNoDiscIsToldApart) {
  const LinkedFaces faces = sphere(600);
  std::vector<std::int32_t> all(faces.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  const auto joined = [](std::int32_t) { return true; };
  EXPECT_FALSE(is_disc(make_chart(faces, all, joined)));
  EXPECT_TRUE(is_disc(make_chart(faces, {0}, joined)));
  Chart belt = cap(faces, 2), top = cap(faces, 1);
  std::vector<std::int32_t> ring;
  std::ranges::set_difference(belt.source, top.source, std::back_inserter(ring));
  EXPECT_FALSE(is_disc(make_chart(faces, ring, joined)));
}

}  // namespace
}  // namespace pelage
