#include "shape/one_sided.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pelage/error.h"
#include "shape/generators.h"
#include "shape/topology.h"

namespace pelage {
namespace {

/// A band of n quadrilaterals around a circle, whose end is sewn to its begin turned over or straight.
std::vector<Triangle> band(std::int32_t n, bool turned) {
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const std::int32_t a = 2 * i, b = a + 1, c = last ? (turned ? 1 : 0) : a + 2, d = last ? (turned ? 0 : 1) : a + 3;
    triangles.push_back({a, c, d});
    triangles.push_back({a, d, b});
  }
  return triangles;
}

TEST(OneSided, AMoebiusBandBecomesAStrip) {
  constexpr std::int32_t n = 7;
  std::vector<Triangle> triangles = band(n, true);
  EXPECT_THROW(make_topology(2 * n, triangles), Error);
  const std::vector<Triangle> original = triangles;
  const std::vector<std::int32_t> before = cut_between_sides(triangles, 2 * n);
  EXPECT_EQ(before.size(), 2 * n + 2U);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(before[triangles[f][k]], original[f][k]);
  const Topology topology = make_topology(before.size(), triangles);  // throws unless it has two sides
  EXPECT_EQ(std::ranges::count(topology.twin, -1), 2 * n + 2);        // the border of one strip
}

TEST(OneSided, WhatHasTwoSidesStaysAsItIs) {
  std::vector<Triangle> straight = band(7, false);
  const auto sphere = builtin_shape("builtin:sphere?n=100");
  for (const auto& [triangles, vertices] :
       {std::pair{straight, std::size_t{14}}, std::pair{sphere.triangles, sphere.points.size()}}) {
    std::vector<Triangle> cut = triangles;
    EXPECT_EQ(cut_between_sides(cut, vertices).size(), vertices);
    EXPECT_EQ(cut, triangles);
  }
}

}  // namespace
}  // namespace pelage
