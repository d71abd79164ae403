#include "shape/split_corners.h"

#include <gtest/gtest.h>

#include "shape/sample_meshes.h"

namespace pelage {
namespace {

/// A cube with one uv square per face: every vertex has three different uv values.
TriangleMesh cube_with_uv() {
  TriangleMesh mesh = test::cube();
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double u = static_cast<double>(f / 2);
    const std::vector<double> square =
        f % 2 == 0 ? std::vector<double>{u, 0, u + 0.5, 0, u + 0.5, 1} : std::vector<double>{u, 0, u + 0.5, 1, u, 1};
    uv.values.insert(uv.values.end(), square.begin(), square.end());
  }
  mesh.attributes.push_back(uv);
  mesh.attributes.push_back({"id", 1, Domain::vertex, {0, 1, 2, 3, 4, 5, 6, 7}});
  return mesh;
}

TEST(SplitCorners, EveryCornerKeepsItsPlaceAndValues) {
  const TriangleMesh mesh = cube_with_uv(), split = split_corners(mesh);
  EXPECT_EQ(split.points.size(), 24U);
  const Attribute &uv = *mesh.find("uv"), &split_uv = *split.find("uv"), &id = *split.find("id");
  EXPECT_EQ(split_uv.domain, Domain::vertex);
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const std::int32_t before = mesh.triangles[c / 3][c % 3], after = split.triangles[c / 3][c % 3];
    EXPECT_EQ(split.points[after], mesh.points[before]);
    EXPECT_EQ(id.values[after], before);
    EXPECT_EQ(split_uv.values[2 * after], uv.values[2 * c]);
    EXPECT_EQ(split_uv.values[2 * after + 1], uv.values[2 * c + 1]);
  }
}

TEST(SplitCorners, FirstVerticesKeepTheirNumbers) {
  const TriangleMesh mesh = cube_with_uv(), split = split_corners(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_EQ(split.points[v], mesh.points[v]);
}

TEST(SplitCorners, SplitsNothingWhereCornersAgree) {
  TriangleMesh mesh = test::torus();
  Attribute corner{"w", 1, Domain::corner, {}};
  for (const Triangle& t : mesh.triangles)
    for (std::int32_t v : t) corner.values.push_back(0.5 * v);
  mesh.attributes.push_back(corner);
  const TriangleMesh split = split_corners(mesh);
  EXPECT_EQ(split.triangles, mesh.triangles);
  EXPECT_EQ(split.points, mesh.points);
}

TEST(SplitCorners, UnusedVertexGetsZero) {
  TriangleMesh mesh = cube_with_uv();
  mesh.points.push_back({9, 9, 9});
  mesh.find("id")->values.push_back(8);
  const TriangleMesh split = split_corners(mesh);
  EXPECT_EQ(split.points[8], (Point{9, 9, 9}));
  EXPECT_EQ(split.find("uv")->values[16], 0);
  EXPECT_EQ(split.find("id")->values[8], 8);
}

}  // namespace
}  // namespace pelage
