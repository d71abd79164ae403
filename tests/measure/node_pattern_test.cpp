#include "measure/node_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "discretise/cell_space.h"
#include "discretise/tet_space.h"
#include "pelage/error.h"
#include "shape/cells.h"
#include "shape/generators.h"
#include "shape/sample_volumes.h"
#include "shape/solid_cells.h"

namespace pelage {
namespace {

using std::numbers::pi;

std::vector<double> values_at(const std::vector<Point>& places, const std::function<double(const Point&)>& u) {
  std::vector<double> values;
  for (const Point& p : places) values.push_back(u(p));
  return values;
}

/// n^3 hexahedra of the unit cube, split.
TetMesh cube(int n) {
  std::vector<Finding> findings;
  return tets_of(test::cube_of_hexahedra(n), findings);
}

/// A plane wave of two periods and a half: layers. Twelve elements to the wave lose 2 % of its height.
TEST(NodePattern, LayersInACube) {
  const TetMesh volume = cube(30);
  const TetSpace space(volume);
  const PatternMeasures m =
      measure_nodes(space, 3, values_at(volume.points, [](const Point& p) { return 3 + std::cos(5 * pi * p[0]); }));
  EXPECT_NEAR(m.area, 1, 1e-9);
  EXPECT_NEAR(m.mean, 3, 1e-3);
  EXPECT_NEAR(m.deviation, std::sqrt(0.5), 0.02);
  EXPECT_EQ(m.above.parts, 3U);  // one end is in the middle of a layer of each kind
  EXPECT_EQ(m.below.parts, 3U);
  EXPECT_NEAR(m.above.share, 0.5, 0.05);
  EXPECT_NEAR(m.wavelength, 0.4, 0.008);
  EXPECT_NEAR(2 * pi / m.spectrum.peak(), 0.4, 0.008);
}

/// cos + cos + cos has one ball to a cube of its wavelength, here 27 whole and half ones around.
TEST(NodePattern, BallsInACube) {
  const TetMesh volume = cube(24);
  const TetSpace space(volume);
  const PatternMeasures m = measure_nodes(
      space, 3,
      values_at(
          volume.points,
          [](const Point& p) { return -std::cos(6 * pi * p[0]) - std::cos(6 * pi * p[1]) - std::cos(6 * pi * p[2]); }),
      1.0);
  EXPECT_EQ(m.above.parts, 27U);
  EXPECT_EQ(m.spots.count, 27U);
  EXPECT_NEAR(m.spots.nearest, 1.0 / 3, 0.005);
  EXPECT_NEAR(m.spacing, std::cbrt(std::numbers::sqrt2 / 27), 1e-9);
  EXPECT_NEAR(m.wavelength, 1.0 / 3, 0.015);
  const double ball = m.above.share / 27;
  EXPECT_NEAR(m.spots.diameter, std::cbrt(6 * ball / pi), 0.02);
}

/// The same of points alone as of the mesh whose vertices they are, with normals that are found.
TEST(NodePattern, CloudsAsTheirMeshes) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=10242");
  const auto spots = [](const Point& p) {
    return std::sin(9 * p[0] + 0.2) * std::sin(9 * p[1] + 0.3) * std::sin(9 * p[2] + 0.4);
  };
  const std::vector<double> values = values_at(mesh.points, spots);
  const PatternMeasures known = measure_pattern(mesh, values);
  const Cells cells = cells_at_points(std::make_shared<const TriangleMesh>(TriangleMesh{mesh.points, {}, {}}));
  ASSERT_EQ(cells.nodes(), mesh.points.size());
  const PatternMeasures found = measure_nodes(CellSpace(cells), 2, values);
  EXPECT_NEAR(found.area / known.area, 1, 0.01);
  EXPECT_NEAR(found.deviation / known.deviation, 1, 0.02);  // linear on triangles loses 1.4 %
  EXPECT_NEAR(found.wavelength / known.wavelength, 1, 0.02);
  EXPECT_NEAR(found.above.share, known.above.share, 0.01);
  EXPECT_EQ(found.above.parts, known.above.parts);
  EXPECT_EQ(found.spots.count, known.spots.count);
  EXPECT_NEAR(found.spots.nearest / known.spots.nearest, 1, 0.04);  // centroids lie under the sphere
  EXPECT_NEAR(found.spots.diameter / known.spots.diameter, 1, 0.03);
  EXPECT_NEAR(found.spectrum.peak() / known.spectrum.peak(), 1, 0.02);
}

TEST(NodePattern, NothingOfAConstant) {
  const TetMesh volume = cube(3);
  const PatternMeasures m = measure_nodes(TetSpace(volume), 3, std::vector<double>(volume.nodes(), 2.0));
  EXPECT_EQ(m.wavelength, 0);
  EXPECT_TRUE(m.spectrum.empty());
  EXPECT_THROW(measure_nodes(TetSpace(volume), 3, {}), Error);
}

}  // namespace
}  // namespace pelage
