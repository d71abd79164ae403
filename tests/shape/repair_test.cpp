#include "shape/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/describe.h"
#include "shape/sample_meshes.h"

namespace pelage {
namespace {

using test::cube;
using test::first_violation;
using test::sheet;
using test::soup;
using test::tetrahedron;
using test::together;
using test::torus;

const Finding* find(const std::vector<Finding>& findings, const std::string& kind) {
  auto it = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.kind == kind; });
  return it == findings.end() ? nullptr : &*it;
}

/// Repairs, checks the promises, and that a second repair finds nothing to do.
TriangleMesh repaired(const TriangleMesh& mesh, std::vector<Finding>& findings) {
  TriangleMesh result = repair(mesh, findings);
  EXPECT_EQ(first_violation(result), "");
  std::vector<Finding> again;
  const TriangleMesh twice = repair(result, again);
  EXPECT_EQ(twice.points, result.points);
  EXPECT_EQ(twice.triangles, result.triangles);
  for (const Finding& f : again) EXPECT_FALSE(f.repaired) << f.text;
  return result;
}

void expect_fault(const TriangleMesh& mesh, ShapeFault::Element element, std::size_t index) {
  std::vector<Finding> findings;
  try {
    repair(mesh, findings);
    FAIL() << "not refused";
  } catch (const ShapeFault& fault) {
    EXPECT_EQ(fault.fault(), Fault::input);
    EXPECT_EQ(fault.element(), element) << fault.what();
    EXPECT_EQ(fault.index(), index) << fault.what();
  }
}

TEST(Repair, LeavesCleanMeshesAlone) {
  for (const TriangleMesh& mesh : {tetrahedron(), cube(), torus(), sheet()}) {
    std::vector<Finding> findings;
    const TriangleMesh result = repaired(mesh, findings);
    EXPECT_TRUE(findings.empty());
    EXPECT_EQ(result.points, mesh.points);
    EXPECT_EQ(result.triangles, mesh.triangles);
  }
}

TEST(Repair, MergesSoupIntoTheMeshThatItCameFrom) {
  for (const TriangleMesh& mesh : {tetrahedron(), torus(), sheet()}) {
    std::vector<Finding> findings;
    const TriangleMesh result = repaired(soup(mesh), findings);
    EXPECT_EQ(result.points.size(), mesh.points.size());
    ASSERT_EQ(result.triangles.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(result.points[result.triangles[f][k]], mesh.points[mesh.triangles[f][k]]);
    ASSERT_TRUE(find(findings, "seams"));
    EXPECT_EQ(find(findings, "seams")->count, 3 * mesh.triangles.size() - mesh.points.size());
  }
}

TEST(Repair, ZeroAndMinusZeroAreOnePlace) {
  TriangleMesh mesh = soup(sheet(2));
  for (std::size_t v = 0; v < mesh.points.size(); v += 2) mesh.points[v][2] = -0.0;
  std::vector<Finding> findings;
  EXPECT_EQ(repaired(mesh, findings).points.size(), 9u);
}

TEST(Repair, AttributesThatDifferAlongASeamMoveToTheCorners) {
  TriangleMesh mesh = soup(sheet(2));
  Attribute same{"same", 1, Domain::vertex, {}}, differs{"uv", 2, Domain::vertex, {}};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    same.values.push_back(mesh.points[v][0] + 10 * mesh.points[v][1]);
    differs.values.insert(differs.values.end(), {static_cast<double>(v), -static_cast<double>(v)});
  }
  mesh.attributes = {same, differs};
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  ASSERT_EQ(result.find("same")->domain, Domain::vertex);
  for (std::size_t v = 0; v < result.points.size(); ++v)
    EXPECT_EQ(result.find("same")->values[v], result.points[v][0] + 10 * result.points[v][1]);
  ASSERT_EQ(result.find("uv")->domain, Domain::corner);
  EXPECT_EQ(result.find("uv")->values, differs.values);  // soup: corner c was vertex c
}

TEST(Repair, DropsUnusedVerticesEvenIfNotFinite) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.insert(mesh.points.begin(), {std::nan(""), 0, 0});
  mesh.points.push_back({7, 7, 7});
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t) ++v;
  mesh.attributes = {{"id", 1, Domain::vertex, {0, 1, 2, 3, 4, 5}}};
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  EXPECT_EQ(result.points, tetrahedron().points);
  EXPECT_EQ(result.find("id")->values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(find(findings, "unused-vertices")->count, 2u);
}

TEST(Repair, DropsDuplicateAndDegenerateFacesWithTheirCorners) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.insert(mesh.triangles.begin() + 1, {{2, 2, 1}, {1, 2, 0}, {2, 1, 0}});
  Attribute tag{"tag", 1, Domain::corner, {}};
  for (int c = 0; c < 21; ++c) tag.values.push_back(c);
  mesh.attributes = {tag};
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  EXPECT_EQ(result.triangles, tetrahedron().triangles);
  EXPECT_EQ(result.find("tag")->values, (std::vector<double>{0, 1, 2, 12, 13, 14, 15, 16, 17, 18, 19, 20}));
  EXPECT_EQ(find(findings, "degenerate-faces")->element, 1u);
  EXPECT_EQ(find(findings, "duplicate-faces")->element, 2u);
  EXPECT_EQ(find(findings, "duplicate-faces")->count, 2u);
}

TEST(Repair, ADoubledSurfaceBecomesSingle) {
  TriangleMesh mesh = torus();
  for (const Triangle& t : torus().triangles) mesh.triangles.push_back({t[0], t[2], t[1]});
  std::vector<Finding> findings;
  EXPECT_EQ(repaired(mesh, findings).triangles, torus().triangles);
}

/// Edge 0-1 of length zero, between two collapsed triangles, as modelling programs make them.
TEST(Repair, CollapsesAnEdgeOfLengthZeroWithoutOpeningTheSurface) {
  TriangleMesh mesh = torus();
  const Triangle t = mesh.triangles[0];
  mesh.points[t[1]] = mesh.points[t[0]];
  std::vector<Finding> findings;
  const MeshReport report = describe(repaired(mesh, findings), {});
  EXPECT_EQ(report.vertices, mesh.points.size() - 1);
  EXPECT_EQ(report.faces, mesh.triangles.size() - 2);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.genus, 1);
}

TEST(Repair, KeepsTrianglesWithoutAreaAndSaysSo) {
  TriangleMesh mesh = cube();  // edge 0-3 cut at its middle on one side only would open it: so cut both faces
  const auto middle = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.push_back({0.5, 0.5, 0});
  mesh.triangles[0] = {0, 2, 3};
  mesh.triangles[1] = {middle, 3, 1};
  mesh.triangles.push_back({0, middle, 1});
  mesh.triangles.push_back({0, 3, middle});
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  EXPECT_EQ(result.triangles.size(), 14u);
  EXPECT_TRUE(describe(result, {}).closed);
  ASSERT_TRUE(find(findings, "zero-area-faces"));
  EXPECT_EQ(find(findings, "zero-area-faces")->element, 13u);
  EXPECT_FALSE(find(findings, "zero-area-faces")->repaired);
}

TEST(Repair, SeparatesSheetsThatShareAVertex) {
  TriangleMesh mesh = together(tetrahedron(), cube({1, 1, 1}));  // corner 0 of the one is corner 0 of the other
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t) v = v == 4 ? 0 : v;
  mesh.attributes = {{"id", 1, Domain::vertex, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}};
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  EXPECT_EQ(describe(result, {}).components, 2u);
  EXPECT_EQ(result.points.size(), 12u);
  EXPECT_EQ(result.find("id")->values, (std::vector<double>{0, 1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 0}));
  EXPECT_TRUE(find(findings, "touching-vertices"));
}

TEST(Repair, SeparatesSolidsThatTouchAlongAnEdge) {
  TriangleMesh mesh = together(cube(), cube({1, 1, 0}));  // 3-7 of the first on 8-12 of the second
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t) v = v == 8 ? 3 : v == 12 ? 7 : v;
  for (const TriangleMesh& input : {mesh, soup(mesh)}) {
    std::vector<Finding> findings;
    const TriangleMesh result = repaired(input, findings);
    const MeshReport report = describe(result, {});
    EXPECT_EQ(report.components, 2u);
    EXPECT_TRUE(report.closed);
    EXPECT_NEAR(report.volume, 2, 1e-12);
    EXPECT_TRUE(find(findings, "touching-edges"));
  }
}

/// Four faces at the edge 0-1 whose sheets are joined around both its ends.
TEST(Repair, TouchingEdgesNeverLeaveAnEdgeOfFourFaces) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {-1, 0, 1}, {-1, 1, 1}, {1, 0, -1}, {-1, 0, -1}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 4}, {0, 1, 7}, {1, 0, 6}, {0, 2, 6}, {0, 4, 7}, {1, 6, 2}, {1, 7, 4}};
  std::vector<Finding> findings;
  try {
    EXPECT_EQ(first_violation(repair(mesh, findings)), "");
  } catch (const ShapeFault&) {
  }
}

TEST(Repair, ClosedSurfacesInOnePlaceStayApart) {
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(together(cube(), cube({1, 0, 0})), findings);
  EXPECT_TRUE(findings.empty());
  EXPECT_EQ(result.points.size(), 16u);
}

TEST(Repair, OrientsConsistentlyAndOutward) {
  TriangleMesh mesh = torus();
  mesh.attributes = {{"tag", 1, Domain::corner, std::vector<double>(3 * mesh.triangles.size())}};
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
    mesh.attributes[0].values[c] = mesh.triangles[c / 3][c % 3];
  std::vector<char> keep(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 3) std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 3)
    std::swap(mesh.attributes[0].values[3 * f + 1], mesh.attributes[0].values[3 * f + 2]);
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  EXPECT_EQ(result.triangles, torus().triangles);
  EXPECT_EQ(find(findings, "flipped-faces")->count, mesh.triangles.size() / 3);
  for (std::size_t c = 0; c < 3 * result.triangles.size(); ++c)
    EXPECT_EQ(result.attributes[0].values[c], result.triangles[c / 3][c % 3]);
}

TEST(Repair, TurnsClosedComponentsOutwardFarFromTheOriginToo) {
  TriangleMesh mesh = together(cube({1e8, -1e8, 1e8}), torus());
  for (std::size_t f = 0; f < 12; ++f) std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  EXPECT_EQ(find(findings, "inward-components")->count, 1u);
  EXPECT_FALSE(find(findings, "flipped-faces"));
  EXPECT_NEAR(describe(result, {}).volume, 1 + test::volume(torus()), 1e-6);
}

TEST(Repair, TheSideIsChosenAfterTheFacesAgree) {
  TriangleMesh mesh = cube();
  int flipped = 0;  // five of the six triangles that see the first vertex of the mesh
  for (Triangle& t : mesh.triangles)
    if (std::find(t.begin(), t.end(), 0) == t.end() && flipped < 5 && mesh.points[t[0]] != Point{0, 0, 0}) {
      const bool far = [&] {
        for (int k = 0; k < 3; ++k)
          if (mesh.points[t[0]][k] == 1 && mesh.points[t[1]][k] == 1 && mesh.points[t[2]][k] == 1) return true;
        return false;
      }();
      if (far) std::swap(t[1], t[2]), ++flipped;
    }
  EXPECT_EQ(flipped, 5);
  std::vector<Finding> findings;
  EXPECT_EQ(repaired(mesh, findings).triangles, cube().triangles);
  EXPECT_EQ(find(findings, "flipped-faces")->count, 5u);
  EXPECT_FALSE(find(findings, "inward-components"));
}

TEST(Repair, AnOpenSheetKeepsItsSide) {
  TriangleMesh mesh = sheet();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  std::vector<Finding> findings;
  const TriangleMesh result = repaired(mesh, findings);
  EXPECT_EQ(find(findings, "flipped-faces")->element, 5u);
  EXPECT_EQ(result.triangles[4], sheet().triangles[4]);
}

TEST(Repair, ClearsAttributesThatAreNotFinite) {
  TriangleMesh mesh = tetrahedron();
  mesh.attributes = {{"heat", 1, Domain::vertex, {1, std::nan(""), 3, INFINITY}}};
  std::vector<Finding> findings;
  EXPECT_EQ(repaired(mesh, findings).find("heat")->values, (std::vector<double>{1, 0, 3, 0}));
  EXPECT_EQ(find(findings, "non-finite-attribute")->count, 2u);
}

TEST(Repair, ReportsCopiesThatDoNotQuiteFit) {
  TriangleMesh mesh = soup(torus());
  for (std::size_t v = 0; v < mesh.points.size(); v += 3) mesh.points[v][0] += 1e-7;
  std::vector<Finding> findings;
  repaired(mesh, findings);
  ASSERT_TRUE(find(findings, "near-copies"));
  EXPECT_FALSE(find(findings, "near-copies")->repaired);
}

TEST(Repair, RefusesWhatItCannotMend) {
  using Element = ShapeFault::Element;
  expect_fault({}, Element::none, 0);
  expect_fault({{{0, 0, 0}}, {}, {}}, Element::none, 0);
  expect_fault({std::vector<Point>(3), {{0, 1, 2}}, {}}, Element::none, 0);

  TriangleMesh mesh = cube();
  mesh.triangles[7][1] = 8;
  expect_fault(mesh, Element::face, 7);
  mesh.triangles[7][1] = -1;
  expect_fault(mesh, Element::face, 7);

  mesh = cube();
  mesh.points[5][1] = std::numeric_limits<double>::quiet_NaN();
  expect_fault(mesh, Element::vertex, 5);
  mesh.points[5][1] = 1e300;
  expect_fault(mesh, Element::vertex, 5);

  mesh = cube();
  mesh.points.push_back({0.5, 0.5, 3});
  mesh.triangles.push_back({4, 5, 8});
  expect_fault(mesh, Element::face, 12);
}

TEST(Repair, RefusesOneSidedSurfaces) {
  TriangleMesh mesh;
  constexpr int n = 9;
  for (int i = 0; i < n; ++i) {
    const double u = 2 * M_PI * i / n;
    for (double s : {-0.4, 0.4})
      mesh.points.push_back(
          {(2 + s * std::cos(u / 2)) * std::cos(u), (2 + s * std::cos(u / 2)) * std::sin(u), s * std::sin(u / 2)});
    const int a = 2 * i, b = 2 * i + 1, c = i + 1 < n ? 2 * i + 2 : 1, d = i + 1 < n ? 2 * i + 3 : 0;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  std::vector<Finding> findings;
  EXPECT_THROW(repair(mesh, findings), ShapeFault);
}

TEST(Repair, MessagesUseTheNumbersOfTheFile) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({1, 1, 2});
  std::vector<Finding> findings;
  std::vector<std::int32_t> source(13);
  for (int f = 0; f < 13; ++f) source[f] = 100 + f / 2;
  repair(mesh, findings, source);
  EXPECT_EQ(findings.at(0).element, 106u);
}

}  // namespace
}  // namespace pelage
