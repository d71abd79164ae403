// Loop elements and simulation meshes on surfaces with creases.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "discretise/assembly.h"
#include "discretise/quadrature.h"
#include "discretise/simulation_mesh.h"
#include "linalg/conjugate_gradient.h"
#include "shape/creases.h"
#include "shape/generators.h"
#include "shape/vectors.h"
#include "support/mesh_facts.h"
#include "support/random_creases.h"

namespace pelage {
namespace {

Topology topology_of(const TriangleMesh& mesh) { return make_topology(mesh.points.size(), mesh.triangles); }

Topology creased(const TriangleMesh& mesh, double degrees) {
  Topology t = topology_of(mesh);
  t.creases = creases_above(degrees, t, mesh.points);
  return t;
}

double side_of(const TriangleMesh& cube) {
  double most = 0;
  for (const Point& p : cube.points) most = std::max(most, p[0]);
  return 2 * most;
}

/// The surface is the cube: its area, and the energy of x, whose gradient is 1 on four of its sides.
TEST(CreaseElements, AreaAndEnergyOfACubeAreExact) {
  const TriangleMesh mesh = builtin_shape("builtin:cube?n=150");
  const Discretisation d = loop_discretisation(creased(mesh, 40));
  const AssembledMatrices m = Assembler(d).mass_and_stiffness(mesh.points);
  const double square = side_of(mesh) * side_of(mesh);
  EXPECT_NEAR(std::accumulate(m.area.begin(), m.area.end(), 0.0), 6 * square, 1e-12 * square);
  Vector x(d.unknowns), one = Vector::Ones(d.unknowns);
  for (Index i = 0; i < d.unknowns; ++i) x[i] = mesh.points[static_cast<std::size_t>(i)][0];
  EXPECT_NEAR(x.dot(m.stiffness * x), 4 * square, 1e-12 * square);
  EXPECT_NEAR(one.dot(m.mass * one), 6 * square, 1e-12 * square);
}

/// Ends, lines and corners anywhere: functions sum to 1, and the refined surface is the same.
TEST(CreaseElements, IdentitiesHoldForAnyCreases) {
  for (const char* name : {"builtin:sphere?n=162", "builtin:plane?n=100", "builtin:animal?n=500"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = builtin_shape(name);
    Topology t = topology_of(mesh);
    t.creases = testing::random_creases(t, 0.15);
    Hierarchy levels(t, loop_refine);
    levels.refine();
    const std::vector<Point> fine = levels.refined(mesh.points, 0, 1);
    const LoopQuadrature accurate{1, 2};
    const Discretisation d = loop_discretisation(t, accurate), f = loop_discretisation(levels.topology(1), accurate);
    for (const ElementClass& c : d.classes) {
      EXPECT_LT((c.value.rowwise().sum() - Vector::Ones(c.points())).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT(c.dv.rowwise().sum().cwiseAbs().maxCoeff(), 1e-11);
    }
    const AssembledMatrices m = Assembler(d).mass_and_stiffness(mesh.points);
    const Vector one = Vector::Ones(d.unknowns);
    EXPECT_LT((m.stiffness * one).cwiseAbs().maxCoeff(), 1e-10);
    const auto area = [](const std::vector<double>& a) { return std::accumulate(a.begin(), a.end(), 0.0); };
    const double coarse_area = area(m.area), fine_area = area(Assembler(f).mass_and_stiffness(fine).area);
    EXPECT_NEAR(coarse_area, fine_area, 1e-3 * fine_area);
  }
}

/// -lap u + u = r on the cube for u = cos(2 pi x / s) + cos(2 pi y / s) + cos(2 pi z / s), an eigenfunction of
/// 4 pi^2 / s^2: on every side two of the terms vary, and no flux leaves it.
double eigenvalue_error(int n) {
  const TriangleMesh mesh = builtin_shape("builtin:cube?n=" + std::to_string(n));
  const double s = side_of(mesh), wave = 2 * std::numbers::pi / s;
  const Discretisation d = loop_discretisation(creased(mesh, 40));
  const AssembledMatrices m = Assembler(d).mass_and_stiffness(mesh.points);
  const QuadratureGeometry g = quadrature_geometry(d, mesh.points);
  Vector load = Vector::Zero(d.unknowns);
  for (std::size_t e = 0; e < d.elements(); ++e) {
    const ElementClass& c = d.classes[static_cast<std::size_t>(d.element_class[e])];
    for (Index q = 0; q < c.points(); ++q) {
      const auto point = static_cast<std::size_t>(d.first_point[e] + q);
      double u = 1;
      for (const double x : g.position[point]) u += std::cos(wave * x);
      for (Index i = 0; i < c.functions(); ++i)
        load[d.function[static_cast<std::size_t>(d.first_function[e] + i)]] += g.weight[point] * c.value(q, i) * u;
    }
  }
  SparseMatrix shifted;
  combine(1, m.stiffness, 1, m.mass, shifted);
  const Vector v = solve_spd(shifted, load, {.tolerance = 1e-12});
  return v.dot(m.stiffness * v) / v.dot(m.mass * v) / (wave * wave) - 1;
}

TEST(CreaseElements, EigenvaluesOfACubeConverge) {
  std::vector<double> errors;
  for (const int n : {150, 602, 2402}) errors.push_back(std::abs(eigenvalue_error(n)));
  for (std::size_t i = 0; i < errors.size(); ++i)
    ::testing::Test::RecordProperty("error_" + std::to_string(i), std::to_string(1e6 * errors[i]));
  EXPECT_GT(std::log2(errors[0] / errors[1]), 2);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 2);
}

/// Of a shape with creases, and how far its mesh's vertices are from their lines.
struct CreasedMesh {
  TriangleMesh shape;
  Hierarchy levels;
  std::vector<Point> control;
  SimulationMesh mesh;

  CreasedMesh(const std::string& name, double edge) : CreasedMesh(builtin_shape(name), edge) {}
  CreasedMesh(TriangleMesh given, double edge)
      : shape(std::move(given)),
        levels(creased(shape, 40), loop_refine),
        control(shape.points),
        mesh(levels, control, {edge, {}}, 1'000'000) {}
};

TEST(CreaseElements, SimulationMeshesKeepTheEdgesOfACube) {
  for (const double share : {0.03, 0.07, 0.21}) {
    SCOPED_TRACE(share);
    const double s = side_of(builtin_shape("builtin:cube?n=386"));
    const CreasedMesh made("builtin:cube?n=386", share * s);
    const Topology& t = *made.mesh.shared_topology();
    const TriangleMesh mesh{made.mesh.points(made.control), t.triangles, {}};
    const testing::MeshFacts facts = testing::mesh_facts(mesh);
    EXPECT_EQ(facts.euler, 2);
    EXPECT_TRUE(facts.closed);
    EXPECT_GT(facts.smallest_angle, 18);
    EXPECT_NEAR(facts.area, 6 * s * s, 1e-9 * s * s);
    const auto sides = [&](const Point& p) {
      return std::ranges::count_if(p, [&](double x) { return std::abs(std::abs(x) - s / 2) < 1e-9 * s; });
    };
    for (const Triangle& triangle : t.triangles) {  // every one on one side
      Point middle{};
      for (const Index v : triangle)
        for (std::size_t k = 0; k < 3; ++k) middle[k] += mesh.points[static_cast<std::size_t>(v)][k] / 3;
      EXPECT_EQ(sides(middle), 1);
    }
    double lines = 0;  // the creases of the mesh are the twelve edges
    for (std::size_t h = 0; h < t.twin.size(); ++h) {
      if (!t.sharp(static_cast<Index>(h))) continue;
      const Point &a = mesh.points[static_cast<std::size_t>(t.origin(static_cast<Index>(h)))],
                  &b = mesh.points[static_cast<std::size_t>(t.target(static_cast<Index>(h)))];
      lines += length(difference(b, a)) / 2;
      EXPECT_EQ(std::min(sides(a), sides(b)) >= 2, true);
    }
    EXPECT_NEAR(lines, 12 * s, 1e-9 * s);
    EXPECT_EQ(std::ranges::count(t.creases.corner, 1), 8);
  }
}

/// A sheet from -1 to 1 that is folded by 50 degrees along x = 0.
TriangleMesh folded_sheet(int n) {
  TriangleMesh sheet;
  const double slope = std::tan(25 * std::numbers::pi / 180);
  for (int j = 0; j <= 2 * n; ++j)
    for (int i = 0; i <= 2 * n; ++i) {
      const double x = static_cast<double>(i) / n - 1, y = static_cast<double>(j) / n - 1;
      sheet.points.push_back({x, y, -slope * std::abs(x)});
      const int a = j * (2 * n + 1) + i, b = a + 1, c = a + 2 * n + 1, d = c + 1;
      if (i < 2 * n && j < 2 * n) sheet.triangles.insert(sheet.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  return sheet;
}

/// Also where the mesh would turn an edge for the sake of valences.
TEST(CreaseElements, SimulationMeshesKeepShallowEdges) {
  const CreasedMesh made(folded_sheet(8), 0.06);
  const std::vector<Point> points = made.mesh.points(made.control);
  for (const Triangle& t : made.mesh.shared_topology()->triangles) {
    double low = 0, high = 0;
    for (const Index v : t) {
      low = std::min(low, points[static_cast<std::size_t>(v)][0]);
      high = std::max(high, points[static_cast<std::size_t>(v)][0]);
    }
    EXPECT_LT(std::min(-low, high), 1e-9);
  }
}

/// A field that is linear on every side, x + 2 y + 3 z, is so between the vertices: each side has gradients of its own.
TEST(CreaseElements, FieldsBetweenVerticesKeepTheirKinks) {
  const double s = side_of(builtin_shape("builtin:cube?n=386"));
  const CreasedMesh made("builtin:cube?n=386", 0.1 * s);
  const Topology& t = *made.mesh.shared_topology();
  const std::vector<Point> points = made.mesh.points(made.control);
  std::vector<std::vector<double>> field(1);
  const auto value = [](const Point& p) { return p[0] + 2 * p[1] + 3 * p[2]; };
  for (const Point& p : points) field[0].push_back(value(p));
  const MeshFields between(t, points, field);
  for (Index f = 0; f < static_cast<Index>(t.triangles.size()); ++f)
    for (const auto& [v, w] : {std::pair{0.5, 0.25}, {0.1, 0.1}, {0.05, 0.9}})
      EXPECT_NEAR(between.at(0, {f, v, w}), value(point_at(t.triangles, points, {f, v, w})), 1e-12);
}

}  // namespace
}  // namespace pelage
