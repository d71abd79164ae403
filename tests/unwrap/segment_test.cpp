// Faces gathered into regions.

#include "unwrap/segment.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "shape/generators.h"

namespace pelage {
namespace {

struct Whole {
  LinkedFaces faces;
  FaceGraph graph;
};

Whole whole(const std::string& name) {
  std::vector<Finding> findings;
  Whole w{link_faces(polygons_of(builtin_shape(name)), findings), {}};
  std::vector<std::int32_t> all(w.faces.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  w.graph = face_graph(w.faces, make_chart(w.faces, all, [](std::int32_t) { return true; }));
  return w;
}

TEST(Segment, ACubeHasSixSides) {
  const Whole cube = whole("builtin:cube?n=600");
  const std::vector<std::int32_t> region = flat_regions(cube.graph, 1e-3);
  std::map<std::int32_t, Eigen::Vector3d> normal;
  for (std::size_t f = 0; f < region.size(); ++f) {
    const auto [found, is_new] = normal.try_emplace(region[f], cube.graph.normal[f]);
    EXPECT_LT((found->second - cube.graph.normal[f]).norm(), 1e-12);
  }
  EXPECT_EQ(normal.size(), 6U);
}

TEST(Segment, RegionsOfASphereAreAsFlatAsAsked) {
  const Whole sphere = whole("builtin:sphere?n=2000");
  for (const double spread : {0.3, 0.1, 0.02}) {
    const std::vector<std::int32_t> region = flat_regions(sphere.graph, spread);
    std::map<std::int32_t, std::pair<Eigen::Vector3d, double>> sums;
    for (std::size_t f = 0; f < region.size(); ++f) {
      auto& [sum, area] = sums.try_emplace(region[f], Eigen::Vector3d::Zero(), 0.0).first->second;
      sum += sphere.graph.area[f] * sphere.graph.normal[f];
      area += sphere.graph.area[f];
    }
    for (const auto& [r, sum] : sums) EXPECT_LT(1 - sum.first.norm() / sum.second, 1.3 * spread);
    // Caps with a spread of s cover a share of s of the sphere.
    EXPECT_GE(static_cast<double>(sums.size()), 1 / spread / 1.3);
    EXPECT_LE(static_cast<double>(sums.size()), 3 / spread);
  }
}

TEST(Segment, HalvesAreTwoPartsAtLeast) {
  for (const char* name : {"builtin:plane?n=400", "builtin:torus?n=600"}) {
    const Whole w = whole(name);
    for (const std::vector<std::int32_t>& region : {halves(w.graph), far_halves(w.graph)}) {
      const auto first = std::ranges::count(region, 0);
      EXPECT_GT(first, std::ssize(region) / 5) << name;
      EXPECT_LT(first, 4 * std::ssize(region) / 5) << name;
    }
  }
}

}  // namespace
}  // namespace pelage
