#include "shape/tet_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shape/normals.h"
#include "shape/sample_volumes.h"
#include "shape/tet_mesh.h"

namespace pelage {
namespace {

TriangleMesh mesh_of(const CarvedBody& body, const std::vector<Point>& nodes) {
  return {body.places(nodes), body.triangles, {}};
}

std::vector<double> values_at(const std::vector<Point>& points, const std::function<double(const Point&)>& f) {
  std::vector<double> values;
  for (const Point& p : points) values.push_back(f(p));
  return values;
}

double wave(const Point& p) { return std::sin(9 * p[0] + 1) * std::cos(7 * p[1]) + std::sin(8 * p[2] - p[0]); }

/// The volume of the part of a tetrahedron where a linear function is above 0: products of parts of edges, the oldest
/// way.
double part_above(std::array<double, 4> u) {
  const auto above = std::ranges::count_if(u, [](double x) { return x > 0; });
  if (above == 0 || above == 4) return above == 4 ? 1 : 0;
  std::ranges::sort(u, std::greater());
  const auto tip = [](double a, double b, double c, double d) { return a / (a - b) * (a / (a - c)) * (a / (a - d)); };
  if (above == 1) return tip(u[0], u[1], u[2], u[3]);
  if (above == 3) return 1 - tip(-u[3], -u[0], -u[1], -u[2]);
  const auto part = [&](std::size_t in, std::size_t out) { return u[in] / (u[in] - u[out]); };
  return part(0, 2) * part(0, 3) + part(0, 2) * (1 - part(0, 3)) * part(1, 3) +
         (1 - part(0, 2)) * part(1, 3) * part(1, 2);
}

double volume_above(const TetMesh& volume, const std::vector<double>& u) {
  double sum = 0;
  for (const Tetrahedron& t : volume.tets) {
    std::array<double, 4> at{};
    std::ranges::transform(t, at.begin(), [&](std::int32_t v) { return u[static_cast<std::size_t>(v)]; });
    sum += part_above(at) * test::volume(volume, t);
  }
  return sum;
}

/// No value so near to the level that the surface keeps off a node.
std::vector<double> away_from_nodes(std::vector<double> u) {
  for (double& x : u)
    if (std::abs(x) < 0.05) x = x < 0 ? -0.05 : 0.05;
  return u;
}

TEST(TetCut, WithoutCutsItIsTheSkin) {
  const TetMesh volume = test::cube_of_tets(3, 0.2);
  const CarvedBody body = carve(volume, {});
  const TriangleMesh mesh = mesh_of(body, volume.points);
  EXPECT_EQ(mesh.points.size(), 56U);
  EXPECT_EQ(mesh.triangles.size(), 2U * 6 * 9);
  EXPECT_EQ(test::open_edges(mesh), 0U);
  EXPECT_NEAR(test::enclosed(mesh), 1, 1e-14);
  EXPECT_EQ(body.side, std::vector<std::uint8_t>(108, 0));
}

TEST(TetCut, ALevelEnclosesWhatLiesAboveIt) {
  for (const double shift : {0.0, 0.2}) {
    const TetMesh volume = test::cube_of_tets(7, shift);
    const std::vector<double> u = away_from_nodes(values_at(volume.points, wave));
    const Cut cut = level_cut(u, 0);
    const CarvedBody body = carve(volume, {&cut, 1});
    const TriangleMesh mesh = mesh_of(body, volume.points);
    EXPECT_EQ(test::open_edges(mesh), 0U);
    EXPECT_NEAR(test::enclosed(mesh), volume_above(volume, u), 1e-12);
    EXPECT_GT(std::ranges::count(body.side, 1), 100);
    EXPECT_GT(std::ranges::count(body.side, 0), 20);
    // What is below is the rest.
    std::vector<double> minus = u;
    for (double& x : minus) x = -x;
    const Cut other = level_cut(minus, 0);
    EXPECT_NEAR(test::enclosed(mesh) + test::enclosed(mesh_of(carve(volume, {&other, 1}), volume.points)), 1, 1e-12);
  }
}

/// Also with values at the level, and plateaus of them.
TEST(TetCut, ALevelIsClosedForAnyValues) {
  const TetMesh volume = test::cube_of_tets(5);
  for (int round = 0; round < 20; ++round) {
    test::Chance chance;
    for (int i = 0; i < 37 * round; ++i) chance.below(2);
    const Cut cut = level_cut(values_at(volume.points, [&](const Point&) { return double(chance.below(3)); }), 1);
    const TriangleMesh mesh = mesh_of(carve(volume, {&cut, 1}), volume.points);
    EXPECT_EQ(test::open_edges(mesh), 0U);
    for (const Triangle& t : mesh.triangles) EXPECT_GT(length(test::area_vector(mesh, t)), 1e-9);
  }
}

double area_of_side(const CarvedBody& body, const TriangleMesh& mesh, int side) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (body.side[t] == side) sum += length(test::area_vector(mesh, mesh.triangles[t]));
  return sum;
}

/// Through cells and, at 0.5, through nodes.
TEST(TetCut, APlaneHasItsAreaAndItsVolume) {
  const TetMesh volume = test::cube_of_tets(4);
  for (const double x : {0.1, 0.25, 0.5, 0.7}) {
    const Cut cut = plane_cut(volume.points, {1, 0, 0}, x);
    const CarvedBody body = carve(volume, {&cut, 1});
    const TriangleMesh mesh = mesh_of(body, volume.points);
    EXPECT_EQ(test::open_edges(mesh), 0U) << x;
    EXPECT_NEAR(test::enclosed(mesh), x, 1e-14);
    EXPECT_NEAR(area_of_side(body, mesh, 1), 1, 1e-13) << x;
    EXPECT_NEAR(area_of_side(body, mesh, 0), 1 + 4 * x, 1e-13) << x;
  }
}

TEST(TetCut, ThePlaneAcrossACubeIsAHexagon) {
  const TetMesh volume = test::cube_of_tets(4, 0.2);
  const Cut cut = plane_cut(volume.points, {1, 1, 1}, 1.5);
  const CarvedBody body = carve(volume, {&cut, 1});
  const TriangleMesh mesh = mesh_of(body, volume.points);
  EXPECT_EQ(test::open_edges(mesh), 0U);
  EXPECT_NEAR(test::enclosed(mesh), 0.5, 1e-14);
  EXPECT_NEAR(area_of_side(body, mesh, 1), 0.75 * std::sqrt(3.0), 1e-13);  // six triangles of side 1 / sqrt 2
}

TEST(TetCut, SeveralCutsMeetInSharpEdges) {
  const TetMesh volume = test::cube_of_tets(4);
  const std::vector<Cut> cuts = {plane_cut(volume.points, {1, 0, 0}, 0.5), plane_cut(volume.points, {0, 1, 0}, 0.3),
                                 plane_cut(volume.points, {0, 1, 1}, 1)};
  const CarvedBody body = carve(volume, cuts);
  const TriangleMesh mesh = mesh_of(body, volume.points);
  EXPECT_EQ(test::open_edges(mesh), 0U);
  EXPECT_NEAR(test::enclosed(mesh), 0.5 * (0.3 * 0.7 + 0.3 * 0.3 / 2), 1e-14);
  EXPECT_NEAR(area_of_side(body, mesh, 2), 0.5 * 0.7, 1e-14);
  EXPECT_NEAR(area_of_side(body, mesh, 3), 0.5 * 0.3 * std::sqrt(2.0), 1e-14);
}

/// A corner is taken out: both cuts end where they meet.
TEST(TetCut, CutsThatBelongTogetherTakeOutACorner) {
  for (const double z : {0.4, 0.5}) {
    const TetMesh volume = test::cube_of_tets(4);
    std::vector<Cut> cuts = {plane_cut(volume.points, {1, 0, 0}, 0.5), plane_cut(volume.points, {0, 0, 1}, z),
                             plane_cut(volume.points, {0, 1, 0}, 0.9)};
    cuts[0].and_next = true;
    const CarvedBody body = carve(volume, cuts);
    const TriangleMesh mesh = mesh_of(body, volume.points);
    EXPECT_EQ(test::open_edges(mesh), 0U);
    EXPECT_NEAR(test::enclosed(mesh), 0.9 * (1 - 0.5 * (1 - z)), 1e-14);
    EXPECT_NEAR(area_of_side(body, mesh, 1), 0.9 * (1 - z), 1e-14);
    EXPECT_NEAR(area_of_side(body, mesh, 2), 0.9 * 0.5, 1e-14);
    EXPECT_NEAR(area_of_side(body, mesh, 3), 1 - 0.5 * (1 - z), 1e-14);
    cuts[1].and_next = true;  // only where y is large
    const TriangleMesh corner = mesh_of(carve(volume, cuts), volume.points);
    EXPECT_EQ(test::open_edges(corner), 0U);
    EXPECT_NEAR(test::enclosed(corner), 1 - 0.1 * 0.5 * (1 - z), 1e-14);
  }
}

/// A sponge that is carved: of the sum over tetrahedra only what lies in the kept half, by mirror images.
TEST(TetCut, PlanesCutWhatALevelLeft) {
  const TetMesh volume = test::cube_of_tets(6);
  const std::vector<double> u = away_from_nodes(values_at(volume.points, wave));
  double sum = 0;
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Cut> cuts = {level_cut(u, 0), plane_cut(volume.points, {sign, 0, 0.3 * sign}, 0.6 * sign)};
    for (const auto& order : {cuts, std::vector<Cut>{cuts[1], cuts[0]}}) {
      const TriangleMesh mesh = mesh_of(carve(volume, order), volume.points);
      EXPECT_EQ(test::open_edges(mesh), 0U);
      sum += test::enclosed(mesh) / 2;
    }
  }
  EXPECT_NEAR(sum, volume_above(volume, u), 2e-3);  // a second cut of a clamped edge moves nothing much
}

TEST(TetCut, NothingMayBeLeft) {
  const TetMesh volume = test::cube_of_tets(2);
  const Cut cut = plane_cut(volume.points, {1, 0, 0}, 0);
  EXPECT_TRUE(carve(volume, {&cut, 1}).triangles.empty());
  EXPECT_EQ(carve(volume, {&cut, 1}).vertices(), 0U);
  const Cut other = plane_cut(volume.points, {-1, 0, 0}, 0);
  EXPECT_NEAR(test::enclosed(mesh_of(carve(volume, {&other, 1}), volume.points)), 1, 1e-14);
}

/// Linear values stay what they are wherever vertices come, also after splits.
TEST(TetCut, ValuesFollow) {
  TetMesh volume = test::cube_of_tets(3, 0.1);
  const std::vector<Cut> cuts = {level_cut(values_at(volume.points, wave), 0.1),
                                 plane_cut(volume.points, {1, 2, 0}, 1.7)};
  CarvedBody body = carve(volume, cuts);
  const auto linear = [](const Point& p) { return 3 * p[0] - p[1] + 0.5 * p[2]; };
  const std::vector<double> f = values_at(volume.points, linear);
  const TriangleMesh before = mesh_of(body, volume.points);
  for (int round = 0; round < 2; ++round) {
    const std::vector<Point> places = body.places(volume.points);
    const std::vector<double> values = body.at_vertices(f, 1);
    ASSERT_EQ(values.size(), places.size());
    for (std::size_t v = 0; v < places.size(); ++v) EXPECT_NEAR(values[v], linear(places[v]), 1e-14);
    body.refine();
  }
  EXPECT_EQ(body.triangles.size(), 16 * before.triangles.size());
  const TriangleMesh after = mesh_of(body, volume.points);
  EXPECT_EQ(test::open_edges(after), 0U);
  EXPECT_NEAR(test::enclosed(after), test::enclosed(before), 1e-14);
}

TEST(TetCut, NamesAreThoseOfTheNearerNode) {
  TetMesh volume = test::cube_of_tets(2);
  const Attribute group{"group",           1,
                        Domain::vertex,    values_at(volume.points, [](const Point& p) { return p[0] > 0.7; }),
                        NumberType::int32, {"left", "right"}};
  const Attribute count{"count", 1, Domain::vertex, group.values, NumberType::int32};
  const Cut cut = plane_cut(volume.points, {1, 0, 0}, 0.8);
  const CarvedBody body = carve(volume, {&cut, 1});
  const std::vector<Point> places = body.places(volume.points);
  const Attribute names = body.at_vertices(group), numbers = body.at_vertices(count);
  EXPECT_EQ(names.type, NumberType::int32);
  EXPECT_EQ(numbers.type, NumberType::float64);
  for (std::size_t v = 0; v < places.size(); ++v) {
    EXPECT_EQ(names.values[v], places[v][0] > 0.75 ? 1 : 0);
    EXPECT_NEAR(numbers.values[v], std::max(0.0, 2 * places[v][0] - 1), 1e-14);
  }
}

// --- blocks ---

Grid block(const std::array<std::int32_t, 3>& count, bool bent = false) {
  Grid grid;
  grid.count = count;
  for (std::size_t d = 0; d < 3; ++d) grid.spacing[d] = 1.0 / (count[d] - 1);
  if (!bent) return grid;
  std::vector<Point> points;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v) {
    const Point p = grid.point(v);
    points.push_back({(1 + p[1]) * std::cos(p[0]), (1 + p[1]) * std::sin(p[0]), p[2]});
  }
  grid.points = points;
  return grid;
}

std::vector<Point> nodes_of(const Grid& grid) {
  std::vector<Point> points;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v) points.push_back(grid.point(v));
  return points;
}

TEST(TetCut, BlocksAreCutAsVolumesAre) {
  const Grid grid = block({7, 5, 6});
  const std::vector<Point> nodes = nodes_of(grid);
  EXPECT_NEAR(test::enclosed(mesh_of(carve(grid, {}), nodes)), 1, 1e-14);
  EXPECT_EQ(carve(grid, {}).triangles.size(), 4U * (6 * 4 + 4 * 5 + 6 * 5));
  const std::vector<Cut> cuts = {plane_cut(nodes, {1, 0, 0}, 0.5), plane_cut(nodes, {0, 1, 0.25}, 0.6)};
  const CarvedBody body = carve(grid, cuts);
  const TriangleMesh mesh = mesh_of(body, nodes);
  EXPECT_EQ(test::open_edges(mesh), 0U);
  EXPECT_NEAR(test::enclosed(mesh), 0.5 * (0.6 - 0.125), 1e-14);
  EXPECT_NEAR(area_of_side(body, mesh, 1), 0.6 - 0.125, 1e-14);
}

/// A ball within a block, and one that its border caps.
TEST(TetCut, LevelsOfBlocksAreClosed) {
  const Grid grid = block({33, 33, 33});
  const std::vector<Point> nodes = nodes_of(grid);
  for (const Point& middle : {Point{0.5, 0.5, 0.5}, Point{0.5, 0.5, 0}}) {
    const Cut cut = level_cut(values_at(nodes, [&](const Point& p) { return -length(difference(p, middle)); }), -0.4);
    const TriangleMesh mesh = mesh_of(carve(grid, {&cut, 1}), nodes);
    EXPECT_EQ(test::open_edges(mesh), 0U);
    const double ball = 4.0 / 3 * std::numbers::pi * 0.064 * (middle[2] == 0 ? 0.5 : 1);
    EXPECT_NEAR(test::enclosed(mesh), ball, 0.005 * ball);
  }
}

/// Bent, and with axes that turn as a left hand does.
TEST(TetCut, BentBlocksFaceOutward) {
  Grid grid = block({9, 7, 5}, true);
  EXPECT_GT(test::enclosed(mesh_of(carve(grid, {}), grid.points)), 0);
  EXPECT_EQ(test::open_edges(mesh_of(carve(grid, {}), grid.points)), 0U);
  for (Point& p : grid.points) p[0] = -p[0];
  EXPECT_GT(test::enclosed(mesh_of(carve(grid, {}), grid.points)), 0);
}

TEST(CornerNormals, AreSmoothOnCurvesAndSharpAtEdges) {
  const Grid grid = block({17, 17, 17});
  const std::vector<Point> nodes = nodes_of(grid);
  const Cut cut = plane_cut(nodes, {1, 1, 0}, 1.1);
  const CarvedBody body = carve(grid, {&cut, 1});
  const std::vector<Point> places = body.places(nodes);
  const Attribute normal = corner_normals(body.triangles, places, body.side);
  const TriangleMesh mesh = mesh_of(body, nodes);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {  // all faces are flat
    const Point flat = unit(test::area_vector(mesh, mesh.triangles[t]));
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(normal.values[9 * t + k], flat[k % 3], 1e-12);
  }
}

}  // namespace
}  // namespace pelage
