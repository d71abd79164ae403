#include "shape/solid_cells.h"

#include <gtest/gtest.h>

#include "shape/sample_volumes.h"
#include "shape/tet_mesh.h"

namespace pelage {
namespace {

using test::cube_of_hexahedra;

std::vector<std::string> kinds_of(const std::vector<Finding>& findings) {
  std::vector<std::string> kinds;
  for (const Finding& f : findings) kinds.push_back(f.kind);
  return kinds;
}

/// Every other cell as six pyramids.
SolidCells mixed_cube(int n, double shift) {
  SolidCells cube = cube_of_hexahedra(n, shift);
  std::vector<SolidCell> cells;
  for (std::size_t c = 0; c < cube.cells.size(); ++c) {
    const auto& v = cube.cells[c].corner;
    if (c % 2 == 0) {
      cells.push_back(cube.cells[c]);
      continue;
    }
    const auto top = static_cast<std::int32_t>(cube.points.size());
    Point middle{};
    for (const std::int32_t corner : v)
      for (std::size_t d = 0; d < 3; ++d) middle[d] += cube.points[static_cast<std::size_t>(corner)][d] / 8;
    cube.points.push_back(middle);
    constexpr std::size_t faces[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                         {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
    for (const auto& f : faces) cells.push_back({CellShape::pyramid, {v[f[0]], v[f[1]], v[f[2]], v[f[3]], top}});
  }
  cube.cells = cells;
  return cube;
}

TEST(SolidCells, PyramidsAndHexahedraShareTheirFaces) {
  for (const double shift : {0.0, 0.1}) {
    std::vector<Finding> findings;
    const TetMesh volume = tets_of(mixed_cube(3, shift), findings);
    EXPECT_TRUE(findings.empty()) << findings[0].text;
    for (const Tetrahedron& t : volume.tets) EXPECT_GT(test::volume(volume, t), 0);
    EXPECT_NEAR(test::volume(volume), 1, 1e-13);
    const TriangleMesh skin = mesh_of(volume);
    EXPECT_EQ(skin.triangles.size(), 2U * 6 * 9);
    EXPECT_EQ(test::open_edges(skin), 0U);
  }
}

TEST(SolidCells, HexahedraShareTheirFacesWhateverTheirNumbers) {
  for (const double shift : {0.0, 0.15}) {
    std::vector<Finding> findings;
    const TetMesh volume = tets_of(cube_of_hexahedra(4, shift), findings);
    EXPECT_TRUE(findings.empty()) << findings[0].text;
    EXPECT_EQ(volume.tets.size(), 6U * 64);
    EXPECT_NEAR(test::volume(volume), 1, 1e-13);
    const TriangleMesh skin = mesh_of(volume);
    EXPECT_EQ(skin.triangles.size(), 2U * 6 * 16);
    EXPECT_EQ(test::open_edges(skin), 0U);
    EXPECT_NEAR(test::area(skin), 6, 1e-12);
    EXPECT_NEAR(test::enclosed(skin), 1, 1e-13);
  }
}

/// A column: a pyramid on a hexahedron on two wedges that share a quadrangle.
TEST(SolidCells, PyramidsAndWedgesFitOnHexahedra) {
  for (int turn = 0; turn < 24; ++turn) {
    std::array<std::int32_t, 13> number{};
    std::iota(number.begin(), number.end(), 0);
    test::Chance chance;
    for (int i = 0; i < 12 * turn; ++i) std::swap(number[chance.below(13)], number[chance.below(13)]);
    const Point places[13] = {{0, 0, 0}, {1, 0, 0},   {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
                              {0, 1, 1}, {.5, .5, 2}, {0, 2, 0}, {1, 2, 0}, {2, 0, 0}, {2, 0, 1}};
    SolidCells cells;
    cells.points.resize(13);
    for (std::size_t v = 0; v < 13; ++v) cells.points[static_cast<std::size_t>(number[v])] = places[v];
    const auto cell = [&](CellShape shape, std::initializer_list<int> corners) {
      SolidCell c{shape, {}};
      std::ranges::transform(corners, c.corner.begin(), [&](int v) { return number[static_cast<std::size_t>(v)]; });
      return c;
    };
    cells.cells = {cell(CellShape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}), cell(CellShape::pyramid, {4, 5, 6, 7, 8}),
                   cell(CellShape::wedge, {3, 9, 7, 2, 10, 6}), cell(CellShape::wedge, {1, 11, 2, 5, 12, 6})};
    std::vector<Finding> findings;
    const TetMesh volume = tets_of(cells, findings);
    EXPECT_TRUE(findings.empty()) << findings[0].text;
    EXPECT_NEAR(test::volume(volume), 1 + 1.0 / 3 + 0.5 + 0.5, 1e-14);
    const TriangleMesh skin = mesh_of(volume);
    EXPECT_EQ(test::open_edges(skin), 0U);
    EXPECT_NEAR(test::enclosed(skin), test::volume(volume), 1e-14);
    EXPECT_EQ(skin.triangles.size(), 2U * 3 + 4 + 2 * (2 * 2 + 2));
  }
}

TEST(SolidCells, SaysWhatItMends) {
  SolidCells cells;
  cells.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}, {1, 1, 0}, {1, 1, 1}};
  const auto tet = [](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    return SolidCell{CellShape::tetrahedron, {a, b, c, d}};
  };
  cells.cells = {tet(0, 1, 2, 3), tet(1, 5, 2, 3), tet(1, 2, 5, 6), tet(0, 1, 2, 5), tet(2, 1, 3, 0)};
  cells.at_nodes = {{"mark", 2, Domain::vertex, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, NAN}}};
  std::vector<Finding> findings;
  const TetMesh volume = tets_of(cells, findings);
  EXPECT_EQ(volume.tets.size(), 3U);
  for (const Tetrahedron& t : volume.tets) EXPECT_GT(test::volume(volume, t), 0);
  EXPECT_EQ(volume.nodes(), 6U);
  EXPECT_EQ(volume.find("mark")->values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 10, 11, 12, 0}));
  EXPECT_EQ(kinds_of(findings), (std::vector<std::string>{"turned-cells", "flat-cells", "duplicate-cells",
                                                          "unused-nodes", "non-finite-attribute"}));
  EXPECT_EQ(findings[1].element, 3U);
  EXPECT_EQ(findings[2].element, 4U);
}

TEST(SolidCells, OverlapsAreNoted) {
  SolidCells cells;
  cells.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, -1}};
  for (const std::int32_t top : {3, 4, 5}) cells.cells.push_back({CellShape::tetrahedron, {0, 1, 2, top}});
  std::vector<Finding> findings;
  tets_of(cells, findings);
  EXPECT_EQ(kinds_of(findings), (std::vector<std::string>{"turned-cells", "overlapping-cells"}));
}

TEST(SolidCells, CollapsedCellsAreWhatIsLeftOfThem) {
  SolidCells cells;
  cells.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}};
  cells.cells = {{CellShape::hexahedron, {0, 1, 2, 3, 4, 5, 5, 4}}};  // the ridge of a roof
  std::vector<Finding> findings;
  const TetMesh roof = tets_of(cells, findings);
  EXPECT_TRUE(findings.empty());
  EXPECT_NEAR(test::volume(roof), 0.5, 1e-15);
  EXPECT_EQ(test::open_edges(mesh_of(roof)), 0U);
}

TEST(SolidCells, ValuesOfCellsComeToNodes) {
  SolidCells cells;
  cells.points = {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}};
  cells.cells = {{CellShape::tetrahedron, {0, 1, 2, 3}}, {CellShape::tetrahedron, {0, 2, 4, 3}}};
  cells.in_cells = {{"heat", 1, Domain::face, {4, 8}, NumberType::float64},
                    {"group", 1, Domain::face, {0, 1}, NumberType::int32, {"a", "b"}}};
  std::vector<Finding> findings;
  const TetMesh volume = tets_of(cells, findings);
  EXPECT_EQ(volume.find("heat")->values, (std::vector<double>{5, 4, 5, 5, 8}));  // volumes 3 and 1
  EXPECT_EQ(volume.find("group")->values, (std::vector<double>{0, 0, 0, 0, 1}));
  EXPECT_EQ(volume.find("group")->labels[1], "b");
  EXPECT_EQ(volume.find("group")->domain, Domain::vertex);
}

TEST(SolidCells, RefusesWhatIsNoVolume) {
  SolidCells cells;
  cells.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  std::vector<Finding> findings;
  EXPECT_THROW(tets_of(cells, findings), ShapeFault);
  cells.cells = {{CellShape::tetrahedron, {0, 1, 2, 3}}};
  EXPECT_THROW(tets_of(cells, findings), ShapeFault);
  cells.points[3][2] = INFINITY;
  EXPECT_THROW(tets_of(cells, findings), ShapeFault);
}

}  // namespace
}  // namespace pelage
