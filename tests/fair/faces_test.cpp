#include "fair/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "shape/sample_meshes.h"

namespace pelage {
namespace {

/// A fan of n triangles around vertex 0, closed.
Topology wheel(int n) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i) triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  return make_topology(static_cast<std::size_t>(n) + 1, triangles);
}

FaceLists neighbours_of(const Topology& topology) { return neighbours(topology, faces_of_vertices(topology)); }

TEST(Neighbours, ShareAVertex) {
  const TriangleMesh torus = test::torus(9);
  const Topology topology = make_topology(torus.points.size(), torus.triangles);
  const FaceLists lists = neighbours_of(topology);
  for (std::size_t f = 0; f < torus.triangles.size(); ++f) {
    std::vector<Index> wanted;
    for (std::size_t g = 0; g < torus.triangles.size(); ++g)
      if (std::ranges::find_first_of(torus.triangles[f], torus.triangles[g]) != torus.triangles[f].end())
        wanted.push_back(static_cast<Index>(g));
    EXPECT_EQ(std::vector<Index>(lists[f].begin(), lists[f].end()), wanted);
  }
}

TEST(Neighbours, OfAVertexWithVeryManyFacesAreTheNearestOnes) {
  const int n = 4000;
  const FaceLists lists = neighbours_of(wheel(n));
  for (const int f : {0, 7, 2000, n - 1}) {
    std::set<Index> wanted;
    for (int step = -16; step <= 16; ++step) wanted.insert((f + step + n) % n);
    EXPECT_EQ(std::set<Index>(lists[f].begin(), lists[f].end()), wanted) << f;
  }
  const FaceLists few = neighbours_of(wheel(60));
  EXPECT_EQ(few[0].size(), 60u);
}

TEST(Discs, HoldAFewHundredFacesWhateverTheRadius) {
  const int n = 1000;
  const std::vector<Vector3> together(n, Vector3::Zero());
  const FaceLists lists = discs(neighbours_of(wheel(n)), together, std::vector<double>(n, 1.0));
  for (int f = 0; f < n; ++f) {
    ASSERT_EQ(lists[f].size(), 256U);
    for (const Index g : lists[f]) ASSERT_LE(std::min((g - f + n) % n, (f - g + n) % n), 256 / 2);  // the nearest
  }
}

}  // namespace
}  // namespace pelage
