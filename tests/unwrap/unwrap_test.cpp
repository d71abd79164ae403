// Atlases of whole meshes: injective, nearly isometric, even, apart from each other.

#include "pelage/unwrap.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/generators.h"
#include "unwrap/atlas_facts.h"

namespace pelage {
namespace {

using std::numbers::pi;
using testing::CutAtlas;
using testing::Step;
using testing::UvCharts;

PolygonMesh with_uv(PolygonMesh mesh, const Unwrapped& unwrapped) {
  mesh.set(unwrapped.uv);
  return mesh;
}

PolygonMesh builtin(const std::string& name) { return polygons_of(builtin_shape("builtin:" + name)); }

/// n x m quads on the rectangle [0, 1]^2, mapped into space; the first and last columns may lie at one place.
template <class Map>
PolygonMesh quads(int n, int m, const Map& map) {
  PolygonMesh mesh;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.push_back(map(1.0 * i / n, 1.0 * j / m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = (n + 1) * j + i;
      mesh.corners.insert(mesh.corners.end(), {a, a + 1, a + n + 2, a + n + 1});
      mesh.end_face();
    }
  return mesh;
}

void expect_sound(const PolygonMesh& mesh, const Unwrapped& unwrapped) {
  const CutAtlas atlas = testing::cut_atlas(with_uv(mesh, unwrapped));
  for (const double x : unwrapped.uv.values) {
    ASSERT_GE(x, 0);
    ASSERT_LE(x, 1);
  }
  EXPECT_EQ(testing::turned_triangles(atlas), 0U);
  EXPECT_EQ(testing::overlapping_pairs(atlas), 0U);
  EXPECT_NEAR(testing::l2_stretch(atlas), unwrapped.report.stretch, 1e-4);
  const UvCharts charts(atlas);
  EXPECT_EQ(charts.euler, std::vector<long>(unwrapped.report.charts, 1));  // discs, all of them
  for (std::size_t t = 0; t < atlas.flat.size(); ++t)
    EXPECT_EQ(unwrapped.chart[atlas.face[t]] == unwrapped.chart[atlas.face[0]],
              charts.of_triangle[t] == charts.of_triangle[0]);
}

TEST(Unwrap, AtlasesOfBuiltInShapesAreInjectiveAndNearlyIsometric) {
  for (const char* name : {"animal?n=3000", "sphere?n=1000", "torus?n=1000", "knot?n=2000", "cube?n=600"}) {
    SCOPED_TRACE(name);
    const PolygonMesh mesh = builtin(name);
    const Unwrapped unwrapped = unwrap(mesh);
    expect_sound(mesh, unwrapped);
    EXPECT_LE(unwrapped.report.worst_stretch, 1.02);
    EXPECT_GT(unwrapped.report.efficiency, 0.5);
    EXPECT_TRUE(unwrapped.findings.empty());
  }
}

TEST(Unwrap, APlaneIsOneChartAndKeepsAllLengths) {
  const PolygonMesh mesh = quads(12, 8, [](double x, double y) { return Point{3 * x + y * y, 2 * y, 0}; });
  const Unwrapped unwrapped = unwrap(mesh);
  expect_sound(mesh, unwrapped);
  EXPECT_EQ(unwrapped.report.charts, 1U);
  EXPECT_NEAR(unwrapped.report.stretch, 1, 1e-9);
  const auto uv = [&](std::size_t c, std::size_t k) { return unwrapped.uv.values[2 * c + k]; };
  for (std::size_t c = 0; c + 1 < mesh.corners.size(); ++c) {
    const Point &p = mesh.points[mesh.corners[c]], &q = mesh.points[mesh.corners[c + 1]];
    const double in_space = std::hypot(p[0] - q[0], p[1] - q[1]);
    EXPECT_NEAR(std::hypot(uv(c, 0) - uv(c + 1, 0), uv(c, 1) - uv(c + 1, 1)), unwrapped.report.scale * in_space, 1e-6);
  }
}

TEST(Unwrap, CylindersAndConesUnrollWithoutStretch) {
  const auto cylinder = [](double x, double y) { return Point{std::cos(2 * pi * x), std::sin(2 * pi * x), 3 * y}; };
  const auto cone = [](double x, double y) {
    const double r = 0.3 + y;
    return Point{r * std::cos(2 * pi * x), r * std::sin(2 * pi * x), -y};
  };
  for (const PolygonMesh& mesh : {quads(40, 10, cylinder), quads(40, 10, cone)}) {
    const Unwrapped unwrapped = unwrap(mesh);
    expect_sound(mesh, unwrapped);
    EXPECT_NEAR(unwrapped.report.worst_stretch, 1, 1e-3);
    EXPECT_LE(unwrapped.report.charts, 4U);
  }
}

TEST(Unwrap, TexelsAreSpreadEvenly) {
  const PolygonMesh mesh = builtin("animal?n=2000");
  const Unwrapped unwrapped = unwrap(mesh);
  std::vector<double> in_space(unwrapped.report.charts), flat(unwrapped.report.charts);
  const CutAtlas atlas = testing::cut_atlas(with_uv(mesh, unwrapped));
  for (std::size_t t = 0; t < atlas.flat.size(); ++t) {
    const auto chart = static_cast<std::size_t>(unwrapped.chart[atlas.face[t]]);
    const auto& [a, b, c] = atlas.mesh.triangles[t];
    const Eigen::Vector3d p(mesh.points[a].data()), q(mesh.points[b].data()), r(mesh.points[c].data());
    in_space[chart] += (q - p).cross(r - p).norm() / 2;
    flat[chart] +=
        std::ldexp(static_cast<double>(testing::turn(atlas.flat[t][0], atlas.flat[t][1], atlas.flat[t][2])), -49);
  }
  for (std::size_t c = 0; c < flat.size(); ++c)
    EXPECT_NEAR(std::sqrt(flat[c] / in_space[c]) / unwrapped.report.scale, 1, 1e-3);
}

double distance(const Step& p, const std::array<Step, 2>& s) {
  const Eigen::Vector2d a(s[0][0], s[0][1]), b(s[1][0], s[1][1]), q(p[0], p[1]);
  const double along = std::clamp((q - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (q - a - along * (b - a)).norm();
}

TEST(Unwrap, ChartsKeepTheirMargins) {
  const PolygonMesh mesh = builtin("animal?n=800");
  for (const auto& [resolution, margin] : {std::pair(512, 6.0), {2048, 3.0}, {256, 0.0}}) {
    const UvCharts charts(testing::cut_atlas(with_uv(mesh, unwrap(mesh, {resolution, margin}))));
    double nearest = 1e300;
    for (const auto& [a, side] : charts.borders)
      for (const auto& [b, other] : charts.borders)
        if (a != b) nearest = std::min({nearest, distance(side[0], other), distance(side[1], other)});
    const double texel = std::ldexp(1.0, 24) / resolution;
    EXPECT_GE(nearest, margin * texel);
    EXPECT_LT(nearest, (margin + 6) * texel);  // room is not given away either
    for (const auto& [chart, side] : charts.borders)
      for (const std::int64_t x : side[0]) {
        EXPECT_GE(static_cast<double>(x), margin / 2 * texel);
        EXPECT_LE(static_cast<double>(x), std::ldexp(1.0, 24) - margin / 2 * texel);
      }
  }
}

TEST(Unwrap, ThreadsAndUnitsDoNotMatter) {
  PolygonMesh mesh = builtin("animal?n=1500");
  const Unwrapped expected = unwrap(mesh);
  {
    const ThreadLimit one(1);
    EXPECT_EQ(unwrap(mesh).uv.values, expected.uv.values);
  }
  for (Point& p : mesh.points)
    for (double& x : p) x *= 1024;
  const Unwrapped larger = unwrap(mesh);
  EXPECT_EQ(larger.uv.values, expected.uv.values);
  EXPECT_EQ(larger.report.scale, expected.report.scale / 1024);
}

/// Every corner with a point of its own.
PolygonMesh loose(const PolygonMesh& mesh) {
  PolygonMesh result{{}, {}, mesh.face_ends, {}, {}};
  for (const std::int32_t v : mesh.corners) {
    result.corners.push_back(static_cast<std::int32_t>(result.points.size()));
    result.points.push_back(mesh.points[v]);
  }
  return result;
}

TEST(Unwrap, FacesHangTogetherByTheirPlaces) {
  const PolygonMesh mesh = builtin("torus?n=600");
  EXPECT_EQ(unwrap(loose(mesh)).uv.values, unwrap(mesh).uv.values);
}

TEST(Unwrap, FoldedSheetsOfThreeAndTurnedFacesComeApart) {
  PolygonMesh book;  // three pages at one spine, and a page whose neighbour is turned the other way
  book.points = {{0, 0, 0},  {0, 0, 1},   {1, 0, 0},   {1, 0, 1}, {-1, 1, 0},
                 {-1, 1, 1}, {-1, -1, 0}, {-1, -1, 1}, {2, 0, 0}, {2, 0, 1}};
  for (const std::array<int, 4>& page : {std::array{0, 2, 3, 1}, {0, 4, 5, 1}, {0, 6, 7, 1}, {2, 3, 9, 8}}) {
    book.corners.insert(book.corners.end(), page.begin(), page.end());
    book.end_face();
  }
  const Unwrapped unwrapped = unwrap(book);
  expect_sound(book, unwrapped);
  EXPECT_EQ(unwrapped.report.charts, 4U);
}

TEST(Unwrap, ARampThatWouldLieOnItselfIsCut) {
  const PolygonMesh ramp = quads(100, 3, [](double x, double y) {
    const double angle = 3 * pi * x, r = 2 - y;  // one and a half turns, almost flat
    return Point{r * std::cos(angle), r * std::sin(angle), 0.2 * x};
  });
  const Unwrapped unwrapped = unwrap(ramp);
  expect_sound(ramp, unwrapped);
  EXPECT_GE(unwrapped.report.charts, 2U);
}

TEST(Unwrap, FacesWithoutAreaAreNotedAndGetUv) {
  PolygonMesh mesh = quads(4, 4, [](double x, double y) { return Point{x, y, 0}; });
  const auto v = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {2, 0, 0}});
  mesh.corners.insert(mesh.corners.end(), {v, v + 1, v + 2, v, v + 3, v + 1});
  mesh.end_face();  // on a line
  mesh.face_ends.back() -= 3;
  mesh.end_face();  // two corners at one place
  const Unwrapped unwrapped = unwrap(mesh);
  ASSERT_EQ(unwrapped.findings.size(), 1U);
  EXPECT_EQ(unwrapped.findings[0].kind, "faces-without-area");
  EXPECT_EQ(unwrapped.findings[0].count, 2U);
  EXPECT_EQ(unwrapped.findings[0].element, 16U);
  for (const double x : unwrapped.uv.values) EXPECT_TRUE(x >= 0 && x <= 1);
  EXPECT_EQ(unwrapped.chart.back(), -1);
}

std::string message(const PolygonMesh& mesh, const UnwrapOptions& options, Fault fault, const Progress& progress = {}) {
  try {
    unwrap(mesh, options, progress);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    return error.what();
  }
  return "nothing";
}

TEST(Unwrap, SaysWhatItCannotDo) {
  const PolygonMesh mesh = builtin("animal?n=500");
  EXPECT_EQ(message({}, {}, Fault::input), "the mesh has no faces to unwrap");
  EXPECT_EQ(message(mesh, {1024, -1}, Fault::usage), "a margin of -1 is not 0 or more");
  EXPECT_EQ(message(mesh, {8, 1}, Fault::usage), "a resolution of 8 is not between 16 and 65536");
  EXPECT_NE(message(mesh, {64, 40}, Fault::usage).find("do not fit the atlas"), std::string::npos);
  EXPECT_NE(message(mesh, {64, 400}, Fault::usage).find("as wide as the atlas"), std::string::npos);
  const Progress stop = [](std::string_view what, double) { return what != "joining charts"; };
  EXPECT_EQ(message(mesh, {}, Fault::cancelled, stop), "interrupted");
}

}  // namespace
}  // namespace pelage
