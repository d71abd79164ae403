#include "shape/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"
#include "pelage/error.h"
#include "shape/cell_shapes.h"
#include "shape/cell_values.h"
#include "shape/cloud_points.h"
#include "shape/generators.h"
#include "support/soups.h"

namespace pelage {
namespace {

std::vector<double> areas(const Cells& cells) {
  const CellShapes shapes(cells);
  CellShapes::Scratch scratch;
  std::vector<double> result;
  for (std::size_t i = 0; i < cells.nodes(); ++i) result.push_back(shapes.shape(i, scratch).area());
  return result;
}

double sum(const std::vector<double>& x) {
  double s = 0;
  for (const double v : x) s += v;
  return s;
}

/// Standard deviation over mean.
double variation(const std::vector<double>& x) {
  const double mean = sum(x) / static_cast<double>(x.size());
  double square = 0;
  for (const double v : x) square += (v - mean) * (v - mean);
  return std::sqrt(square / static_cast<double>(x.size())) / mean;
}

double area_of(const TriangleMesh& mesh) {
  double a = 0;
  for (const Triangle& t : mesh.triangles)
    a += length(cross(difference(mesh.points[t[1]], mesh.points[t[0]]),
                      difference(mesh.points[t[2]], mesh.points[t[0]]))) /
         2;
  return a;
}

TEST(Cells, HaveTheAreaOfTheirSurfaceInEqualShares) {
  for (const char* name : {"builtin:sphere?n=5000", "builtin:animal", "builtin:torus"}) {
    const auto mesh = shared(builtin_shape(name));
    const std::vector<double> a = areas(make_cells(mesh, 3000));
    EXPECT_NEAR(sum(a) / area_of(*mesh), 1, 0.01) << name;
    EXPECT_LT(variation(a), 0.1) << name;  // at random it would be 0.53
  }
}

TEST(Cells, EndWhereAnOpenSurfaceEnds) {
  const auto plane = shared(builtin_shape("builtin:plane"));
  EXPECT_NEAR(sum(areas(make_cells(plane, 1000))) / area_of(*plane), 1, 1e-6);
}

TEST(Cells, GoOnOverCracksAndTJunctions) {
  const auto cube = shared(six_squares());
  const Cells cells = make_cells(cube, 1500);
  EXPECT_NEAR(sum(areas(cells)) / 6, 1, 0.01);
  const CellShapes shapes(cells);
  EXPECT_TRUE(border_pieces(cells, shapes.neighbours()).empty());
  const Cells flat = make_cells(shared(square_with_t_junctions()), 800);
  const std::vector<double> a = areas(flat);
  EXPECT_NEAR(sum(a) / 2, 1, 1e-3);
  const CellShapes flat_shapes(flat);
  for (const BorderPiece& p : border_pieces(flat, flat_shapes.neighbours()))
    EXPECT_TRUE(p.middle[1] == 0 || p.middle[1] == 1 || p.middle[0] == 0 || p.middle[0] == 2) << p.middle[0];
  // Those at the crack are as wide as those inside.
  std::vector<double> at_crack, inside;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point& p = flat.points[i];
    if (std::min({p[0], 2 - p[0], p[1], 1 - p[1]}) < flat.radius) continue;
    (std::abs(p[0] - 1) < flat.radius / 2 ? at_crack : inside).push_back(a[i]);
  }
  const auto mean = [](const std::vector<double>& x) { return sum(x) / static_cast<double>(x.size()); };
  EXPECT_NEAR(mean(at_crack) / mean(inside), 1, 0.03);
}

TEST(Cells, AreTheSameForAnyNumberOfThreads) {
  const auto animal = shared(builtin_shape("builtin:animal"));
  const Cells many = make_cells(animal, 2000);
  const ThreadLimit limit(1);
  const Cells one = make_cells(animal, 2000);
  EXPECT_EQ(many.points, one.points);
  EXPECT_EQ(many.face, one.face);
}

TEST(Cells, LieWhereTheySay) {
  const auto animal = shared(builtin_shape("builtin:animal"));
  const Cells cells = make_cells(animal, 500);
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    const Triangle& t = animal->triangles[static_cast<std::size_t>(cells.face[i])];
    const auto [v, w] = cells.place[i];
    EXPECT_GE(v, 0);
    EXPECT_GE(w, 0);
    EXPECT_LE(v + w, 1 + 1e-12);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(cells.points[i][k],
                  (1 - v - w) * animal->points[t[0]][k] + v * animal->points[t[1]][k] + w * animal->points[t[2]][k],
                  1e-12);
  }
}

/// The two sides of a thin sheet know nothing of each other.
TEST(Cells, DoNotReachThroughAThinSheet) {
  TriangleMesh sheet;
  add_square(sheet, {0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  add_square(sheet, {0, 0, 0.001}, {1, 0, 0}, {0, 1, 0});
  const Cells cells = make_cells(shared(sheet), 600);
  const CellShapes shapes(cells);
  CellShapes::Scratch scratch;
  for (std::size_t i = 0; i < cells.nodes(); ++i)
    for (const PlaneCell::Beyond& b : shapes.shape(i, scratch).beyond)
      EXPECT_TRUE(b.cell < 0 || cells.normals[i] == cells.normals[static_cast<std::size_t>(b.cell)]);
}

struct Joints {
  int right = 0, wrong = 0;  ///< pairs of cells of both spheres that are both outside or both inside, and others
};
Joints joints(double distance) {
  const TriangleMesh both = two_spheres(distance, builtin_shape("builtin:sphere?n=10000"));
  const auto half = static_cast<std::int32_t>(both.triangles.size() / 2);
  const Cells cells = make_cells(shared(both), 6000);
  const CellShapes shapes(cells);
  CellShapes::Scratch scratch;
  const auto outside = [&](std::size_t i) {
    const Point other = {cells.face[i] < half ? distance : 0, 0, 0};
    return length(difference(cells.points[i], other)) > 1;
  };
  Joints result;
  for (std::size_t i = 0; i < cells.nodes(); ++i)
    for (const PlaneCell::Beyond& b : shapes.shape(i, scratch).beyond) {
      if (b.cell < 0 || (cells.face[i] < half) == (cells.face[static_cast<std::size_t>(b.cell)] < half)) continue;
      (outside(i) == outside(static_cast<std::size_t>(b.cell)) ? result.right : result.wrong) += 1;
    }
  return result;
}

/// Parts that overlap are one outside; those that touch in a point, or leave a small gap, are two.
TEST(Cells, GoOnFromOnePartToAnother) {
  const Joints overlap = joints(1.2), touching = joints(2), gap = joints(2.02);
  EXPECT_GT(overlap.right, 300);
  EXPECT_LT(overlap.wrong, overlap.right / 10);
  EXPECT_EQ(touching.right + touching.wrong + gap.right + gap.wrong, 0);
}

TEST(Cells, AreAsManyAsAnEdgeNeeds) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=5000");
  const std::size_t n = cells_for_edge(sphere, 0.1);
  EXPECT_NEAR(static_cast<double>(n), 2 / std::sqrt(3.0) * area_of(sphere) / 0.01, 1);
  EXPECT_THROW(make_cells(shared(sphere), 3), Error);
  EXPECT_THROW(cells_for_edge(sphere, 1e-6), Error);
  EXPECT_THROW(make_cells(shared({}), 100), Error);
}

TEST(Cells, CarryTheAttributesOfTheirPlaces) {
  TriangleMesh sphere = builtin_shape("builtin:sphere?n=5000");
  Attribute height{"height", 1, Domain::vertex, {}}, half{"half", 1, Domain::face, {}};
  for (const Point& p : sphere.points) height.values.push_back(p[2]);
  for (const Triangle& t : sphere.triangles) half.values.push_back(sphere.points[t[0]][2] > 0);
  sphere.set(height);
  sphere.set(half);
  sphere.metres_per_unit = 0.01;
  const TriangleMesh mesh = mesh_of(make_cells(shared(sphere), 300));
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(mesh.metres_per_unit, 0.01);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_NEAR(mesh.find("height")->values[i], mesh.points[i][2], 1e-12);
    const double z = mesh.points[i][2];
    EXPECT_TRUE(std::abs(z) < 0.1 || (mesh.find("half")->values[i] != 0) == (z > 0)) << z;
    EXPECT_NEAR(mesh.find("normal")->values[3 * i], mesh.points[i][0], 0.1);
  }
}

/// Ten times as many points above as below, and some of all again.
TriangleMesh uneven_cloud() {
  TriangleMesh cloud;
  for (std::uint64_t i = 0; i < 40000; ++i) {
    const double z = 2 * uniform(1, i) - 1, phi = 2 * std::numbers::pi * uniform(2, i), r = std::sqrt(1 - z * z);
    if (z < 0 && uniform(3, i) > 0.1) continue;
    cloud.points.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  for (std::size_t i = 0; i < 3000; ++i) cloud.points.push_back(cloud.points[5 * i]);
  return cloud;
}

TEST(CloudCells, AreEvenOnAnUnevenCloud) {
  const Cells cells = make_cells(shared(uneven_cloud()), 2000);
  const double area = 4 * std::numbers::pi;
  EXPECT_NEAR(cells.radius * cells.radius * 2000 / 4 / area, 1, 0.03);
  const std::vector<double> a = areas(cells);
  EXPECT_NEAR(sum(a) / area, 1, 0.02);
  EXPECT_LT(variation(a), 0.1);
  std::size_t above = 0;
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    above += cells.points[i][2] > 0;
    EXPECT_NEAR(length(cells.points[i]), 1, 0.02);
    EXPECT_GT(dot(cells.points[i], cells.normals[i]), 0.9);  // outwards, all of them
  }
  EXPECT_NEAR(static_cast<double>(above) / 1000, 1, 0.05);
}

TEST(CloudCells, LeaveOutliersAlone) {
  TriangleMesh cloud = uneven_cloud();
  for (std::uint64_t i = 0; i < 200; ++i)
    cloud.points.push_back({9 * uniform(5, i) - 4.5, 9 * uniform(6, i) - 4.5, 9 * uniform(7, i) - 4.5});
  cloud.points.push_back({1e12, 0, 0});
  cloud.points.push_back({0, NAN, 0});
  const CloudPoints points = cloud_points(cloud);
  EXPECT_GT(points.outliers, 190u);  // a few lie on the sphere itself
  EXPECT_LT(points.outliers, 215u);
  for (const Point& p : make_cells(shared(cloud), 1000).points) EXPECT_NEAR(length(p), 1, 0.05);
}

TEST(CloudCells, FollowNormalsThatAreGiven) {
  TriangleMesh cloud = cloud_of(builtin_shape("builtin:sphere?n=3000"));
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (const Point& p : cloud.points)
    for (const double x : p) normal.values.push_back(-2 * x);
  std::fill(normal.values.begin(), normal.values.begin() + 300, 0.0);  // some say nothing
  cloud.set(normal);
  const Cells cells = make_cells(shared(cloud), 500);
  for (std::size_t i = 0; i < cells.nodes(); ++i) EXPECT_LT(dot(cells.points[i], cells.normals[i]), -0.9);
}

TEST(CloudCells, AreRefusedWhereThereIsNoSurface) {
  TriangleMesh few, line, one;
  for (int i = 0; i < 10; ++i) few.points.push_back({1.0 * i, 0.5 * i * i, 0});
  for (int i = 0; i < 200; ++i) line.points.push_back({1.0 * i, 0, 0});
  one.points.assign(500, Point{1, 2, 3});
  for (const TriangleMesh& cloud : {few, one, line}) EXPECT_THROW(make_cells(shared(cloud), 100), Error);
  TriangleMesh ring;
  for (int i = 0; i < 200; ++i) ring.points.push_back({std::cos(0.01 * M_PI * i), std::sin(0.01 * M_PI * i), 0});
  EXPECT_THROW(make_cells(shared(ring), 100), Error);
}

TEST(CellValues, AreMeansThatKeepConstants) {
  const Cells cells = make_cells(shared(builtin_shape("builtin:sphere?n=5000")), 2000);
  const CellValues values(cells);
  std::vector<CellValues::Weight> found;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Point n = unit({uniform(1, i) - 0.5, uniform(2, i) - 0.5, uniform(3, i) - 0.5});
    values.at(n, n, found);
    double one = 0, height = 0;
    Point slope{};
    for (const CellValues::Weight& w : found) {
      one += w.share;
      height += w.share * cells.points[static_cast<std::size_t>(w.cell)][2];
      for (std::size_t k = 0; k < 3; ++k) slope[k] += w.slope[k] * cells.points[static_cast<std::size_t>(w.cell)][2];
    }
    EXPECT_NEAR(one, 1, 1e-12);
    EXPECT_NEAR(height, n[2], 0.02);
    EXPECT_NEAR(dot(slope, slope), 1 - n[2] * n[2], 0.12);
  }
  values.at({1.5, 0, 0}, {-1, 0, 0}, found);  // where no cell of that sheet is near: the nearest
  EXPECT_EQ(found.size(), 1u);
}

}  // namespace
}  // namespace pelage
