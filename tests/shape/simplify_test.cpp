#include "shape/simplify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "shape/generators.h"
#include "shape/topology.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

TriangleMesh colored(TriangleMesh mesh, double (*grey)(const Point&)) {
  Attribute color{"color", 3, Domain::vertex, {}};
  for (const Point& p : mesh.points) color.values.insert(color.values.end(), 3, grey(p));
  mesh.set(std::move(color));
  return mesh;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point& a = mesh.points[static_cast<std::size_t>(t[0])];
    sum += length(cross(difference(mesh.points[static_cast<std::size_t>(t[1])], a),
                        difference(mesh.points[static_cast<std::size_t>(t[2])], a))) /
           2;
  }
  return sum;
}

Index characteristic(const TriangleMesh& mesh) {
  const Topology t = make_topology(mesh.points.size(), mesh.triangles);
  return static_cast<Index>(mesh.points.size()) - t.edge_count + static_cast<Index>(mesh.triangles.size());
}

bool is_closed(const TriangleMesh& mesh) {
  const Topology t = make_topology(mesh.points.size(), mesh.triangles);
  return std::ranges::count(t.twin, -1) == 0;
}

TEST(Simplify, ClosedSurfacesStayClosedAndOfTheirKind) {
  for (const auto& [name, kind] : {std::pair{"builtin:sphere?n=2562", 2}, {"builtin:torus?n=2304", 0}}) {
    const TriangleMesh mesh = builtin_shape(name), fewer = simplify(mesh, 400);
    EXPECT_LE(fewer.triangles.size(), 400U);
    EXPECT_GT(fewer.triangles.size(), 395U);
    EXPECT_TRUE(is_closed(fewer)) << name;
    EXPECT_EQ(characteristic(fewer), kind) << name;
  }
}

TEST(Simplify, VerticesAreThoseOfTheMeshWithTheirValues) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  Attribute number{"number", 1, Domain::vertex, {}};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) number.values.push_back(static_cast<double>(v));
  mesh.set(std::move(number));
  const TriangleMesh fewer = simplify(mesh, 100);
  const Attribute* left = fewer.find("number");
  ASSERT_TRUE(left);
  ASSERT_EQ(left->values.size(), fewer.points.size());
  for (std::size_t v = 0; v < fewer.points.size(); ++v)
    EXPECT_EQ(fewer.points[v], mesh.points[static_cast<std::size_t>(left->values[v])]);
}

/// The area that a polyhedron with n faces lacks goes with 1/n; this one is that of a good one within a factor of two.
TEST(Simplify, AreaIsKeptToFirstOrderInTheNumberOfTriangles) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=10242");
  const double whole = area(mesh);
  const double coarse = 1 - area(simplify(mesh, 500)) / whole, fine = 1 - area(simplify(mesh, 2000)) / whole;
  EXPECT_LT(fine, 2 * area(builtin_shape("builtin:sphere?n=1002")) / whole * 0.0036);
  EXPECT_NEAR(std::log2(coarse / fine) / 2, 1, 0.2);
}

/// A flat sheet of one colour needs no inner vertices, and its border no more than its corners.
TEST(Simplify, FlatSheetsKeepTheirBorder) {
  const TriangleMesh mesh = colored(builtin_shape("builtin:plane?n=1600"), [](const Point&) { return 0.5; });
  const TriangleMesh fewer = simplify(mesh, 60);
  EXPECT_LE(fewer.triangles.size(), 60U);
  EXPECT_NEAR(area(fewer), area(mesh), 1e-9);
  EXPECT_EQ(characteristic(fewer), 1);
}

/// Vertices go where colours change: a black and a white half of a flat sheet meet where they met.
TEST(Simplify, BordersOfColourStay) {
  const auto grey = [](const Point& p) { return p[0] * p[0] + p[1] * p[1] < 0.09 ? 1.0 : 0.0; };
  TriangleMesh mesh = builtin_shape("builtin:plane?n=10000");
  const TriangleMesh dotted = colored(mesh, grey), fewer = simplify(dotted, 1500);
  const auto white = [](const TriangleMesh& m) {
    double sum = 0;
    const Attribute& c = *m.find("color");
    for (const Triangle& t : m.triangles) {
      TriangleMesh one;
      double mean = 0;
      for (const Index v : t) {
        one.points.push_back(m.points[static_cast<std::size_t>(v)]);
        mean += c.values[3 * static_cast<std::size_t>(v)] / 3;
      }
      one.triangles = {{0, 1, 2}};
      sum += mean * area(one);
    }
    return sum;
  };
  EXPECT_NEAR(white(fewer), white(dotted), 0.01 * white(dotted));
  const double without_colour = [&] {
    TriangleMesh plain = dotted;
    plain.attributes[0].name = "grey";
    TriangleMesh left = simplify(plain, 1500);
    left.find("grey")->name = "color";
    return white(left);
  }();
  EXPECT_GT(std::abs(without_colour - white(dotted)), 3 * std::abs(white(fewer) - white(dotted)));
}

/// A seam of texture coordinates keeps its vertices, and every corner the coordinates of its side.
TEST(Simplify, SeamsKeepBothSides) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  Attribute uv{"uv", 2, Domain::corner, {}};
  const auto longitude = [](const Point& p) { return std::atan2(p[1], p[0]) / (2 * std::numbers::pi) + 0.5; };
  for (const Triangle& t : mesh.triangles) {
    std::array<double, 3> u;
    for (std::size_t k = 0; k < 3; ++k) u[k] = longitude(mesh.points[static_cast<std::size_t>(t[k])]);
    const double most = std::max({u[0], u[1], u[2]});
    for (std::size_t k = 0; k < 3; ++k) {
      if (most - u[k] > 0.5) u[k] += 1;
      uv.values.insert(uv.values.end(), {u[k], mesh.points[static_cast<std::size_t>(t[k])][2]});
    }
  }
  mesh.set(std::move(uv));
  const TriangleMesh fewer = simplify(mesh, 800);
  EXPECT_LE(fewer.triangles.size(), 800U);
  EXPECT_TRUE(is_closed(fewer));
  const Attribute& left = *fewer.find("uv");
  ASSERT_EQ(left.values.size(), 6 * fewer.triangles.size());
  for (std::size_t c = 0; c < 3 * fewer.triangles.size(); ++c) {
    const Point& p = fewer.points[static_cast<std::size_t>(fewer.triangles[c / 3][c % 3])];
    EXPECT_EQ(left.values[2 * c + 1], p[2]);
    const double turns = left.values[2 * c] - longitude(p);
    EXPECT_NEAR(turns, std::round(turns), 1e-12);
  }
  for (std::size_t f = 0; f < fewer.triangles.size(); ++f) {
    const Point& p = fewer.points[static_cast<std::size_t>(fewer.triangles[f][0])];
    if (std::abs(p[2]) > 0.9) continue;  // around the poles faces have all longitudes
    const auto [low, high] = std::minmax({left.values[6 * f], left.values[6 * f + 2], left.values[6 * f + 4]});
    EXPECT_LT(high - low, 0.55) << "a face across the seam";
  }
}

/// Faces of different materials keep their border.
TEST(Simplify, LabelsOfFacesKeepTheirBorder) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  Attribute material{"material", 1, Domain::face, {}, NumberType::int32, {"upper", "lower"}};
  std::map<int, double> before, after;
  const auto areas = [](const TriangleMesh& m, std::map<int, double>& sums) {
    for (std::size_t f = 0; f < m.triangles.size(); ++f) {
      TriangleMesh one{m.points, {m.triangles[f]}, {}};
      sums[static_cast<int>(m.find("material")->values[f])] += area(one);
    }
  };
  for (const Triangle& t : mesh.triangles)
    material.values.push_back(mesh.points[static_cast<std::size_t>(t[0])][2] > 0 ? 0 : 1);
  mesh.set(std::move(material));
  const TriangleMesh fewer = simplify(mesh, 700);
  areas(mesh, before);
  areas(fewer, after);
  for (const int m : {0, 1}) EXPECT_NEAR(after[m], before[m], 0.02 * before[m]);
}

TEST(Simplify, AsManyAsThereAreChangeNothing) {
  const TriangleMesh mesh = builtin_shape("builtin:cube?n=386");
  EXPECT_EQ(simplify(mesh, mesh.triangles.size()).points, mesh.points);
}

/// Where nothing more can go, no face is left without an area.
TEST(Simplify, StopsAtWhatKeepsTheTopology) {
  const TriangleMesh fewer = simplify(builtin_shape("builtin:torus?n=576"), 1);
  EXPECT_TRUE(is_closed(fewer));
  EXPECT_EQ(characteristic(fewer), 0);
  EXPECT_GT(fewer.triangles.size(), 13U);
}

}  // namespace
}  // namespace pelage
