#include "shape/locate.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "shape/closest_point.h"
#include "shape/generators.h"
#include "shape/loop_subdivision.h"
#include "support/mesh_facts.h"
#include "verify/triangulations.h"

namespace pelage {
namespace {

using testing::vec;

Topology topology_of(const TriangleMesh& mesh) { return make_topology(mesh.points.size(), mesh.triangles); }

/// Distance to the nearest point of all triangles, one after the other.
double brute_distance(const TriangleMesh& mesh, const Point& p) {
  double best = 1e300;
  for (const Triangle& t : mesh.triangles)
    best = std::min(best, square_distance(p, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
  return std::sqrt(best);
}

void expect_inside(const MeshPlace& place) {
  EXPECT_GE(place.face, 0);
  EXPECT_GE(place.v, 0);
  EXPECT_GE(place.w, 0);
  EXPECT_LE(place.v + place.w, 1 + 1e-15);
}

TEST(SurfaceWalk, FindsWhatComparingAllTrianglesFinds) {
  for (const char* shape : {"builtin:torus?n=1000", "builtin:knot?n=1000", "builtin:plane?n=400"}) {
    SCOPED_TRACE(shape);
    const TriangleMesh mesh = builtin_shape(shape), near = builtin_shape("builtin:sphere?n=300");
    const SurfaceWalk surface(topology_of(mesh), mesh.points);
    for (std::size_t i = 0; i < near.points.size(); ++i) {
      const auto face = static_cast<Index>(i * 7 % mesh.triangles.size());
      const Eigen::Vector3d p = surface.point({face, 0.3, 0.3}) + 0.02 * vec(near.points[i]);
      const double truth = brute_distance(mesh, {p.x(), p.y(), p.z()});
      const MeshPlace walked = surface.closest(p, face), found = surface.search(p, Eigen::Vector3d::Zero());
      const auto somewhere = static_cast<Index>(i * 31 % mesh.triangles.size());
      EXPECT_NEAR((surface.point(surface.search(p, Eigen::Vector3d::Zero(), somewhere)) - p).norm(), truth, 1e-12);
      expect_inside(walked);
      EXPECT_NEAR((surface.point(walked) - p).norm(), truth, 1e-12);
      EXPECT_NEAR((surface.point(found) - p).norm(), truth, 1e-12);
    }
  }
}

TEST(SurfaceWalk, CrossesAWholeSurfaceAndSlidesAlongBoundaries) {
  const TriangleMesh plane = builtin_shape("builtin:plane?n=400");
  const SurfaceWalk surface(topology_of(plane), plane.points);
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0.81, 0.33, 0.5), Eigen::Vector3d(1.7, 0.4, 0.1), Eigen::Vector3d(2, -3, 0)}) {
    const Eigen::Vector3d truth(std::clamp(p.x(), 0.0, 1.0), std::clamp(p.y(), 0.0, 1.0), 0);
    for (Index face = 0; face < static_cast<Index>(plane.triangles.size()); face += 37)
      EXPECT_NEAR((surface.point(surface.closest(p, face)) - truth).norm(), 0, 1e-12);
  }
}

/// A square plate with two sheets, a rim of one row of triangles around, and the given thickness.
TriangleMesh plate(int n, double thickness) {
  TriangleMesh mesh;
  const auto at = [n](int i, int j, int sheet) { return sheet * (n + 1) * (n + 1) + j * (n + 1) + i; };
  for (int sheet : {0, 1})
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.points.push_back({double(i) / n, double(j) / n, sheet * thickness});
  const auto quad = [&](int a, int b, int c, int d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      quad(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
      quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
    }
  for (int i = 0; i < n; ++i) {
    quad(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1));
    quad(at(n, i, 0), at(n, i + 1, 0), at(n, i + 1, 1), at(n, i, 1));
    quad(at(i + 1, n, 0), at(i, n, 0), at(i, n, 1), at(i + 1, n, 1));
    quad(at(0, i + 1, 0), at(0, i, 0), at(0, i, 1), at(0, i + 1, 1));
  }
  return mesh;
}

TEST(Locate, KeepsTheSheetsOfAThinPlateApart) {
  const TriangleMesh coarse = plate(7, 1e-3), fine = plate(20, 1e-3);
  for (const auto& [from, to] : {std::pair(&fine, &coarse), std::pair(&coarse, &fine)}) {
    const SurfaceWalk surface(topology_of(*to), to->points);
    const std::vector<MeshPlace> places = locate(topology_of(*from), from->points, surface);
    for (std::size_t v = 0; v < places.size(); ++v)
      EXPECT_NEAR((surface.point(places[v]) - vec(from->points[v])).norm(), 0, 1e-14);
  }
}

TEST(Locate, CarriesSmoothFunctionsToSecondOrder) {
  const TriangleMesh fine = unit_sphere(SphereTriangulation::slivers, 4000);
  const auto value = [](const Point& p) { return p[0] * p[1] + std::sin(2 * p[2]); };
  double before = 0;
  for (int n : {500, 2000, 8000}) {
    const TriangleMesh base = unit_sphere(SphereTriangulation::uniform, n);
    std::vector<double> values;
    for (const Point& p : base.points) values.push_back(value(p));
    const std::vector<MeshPlace> places =
        locate(topology_of(fine), fine.points, SurfaceWalk(topology_of(base), base.points));
    double error = 0;
    for (std::size_t v = 0; v < places.size(); ++v)
      error = std::max(error, std::abs(value_at(base.triangles, values, places[v]) - value(fine.points[v])));
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 2, 0.4);
    }
    before = error;
  }
}

TEST(Locate, FindsEveryComponent) {
  TriangleMesh many, refined;
  for (int k = 0; k < 5; ++k)
    for (auto [mesh, n] : {std::pair(&many, 200), std::pair(&refined, 900)}) {
      TriangleMesh sphere = unit_sphere(SphereTriangulation::uniform, n);
      const auto first = static_cast<Index>(mesh->points.size());
      for (const Point& p : sphere.points) mesh->points.push_back({p[0] + 2.01 * k, p[1], p[2]});
      for (const Triangle& t : sphere.triangles) mesh->triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  many.points.push_back({0, 0, 0});  // belongs to no triangle
  const SurfaceWalk surface(topology_of(refined), refined.points);
  const std::vector<MeshPlace> places = locate(topology_of(many), many.points, surface);
  EXPECT_EQ(places.back().face, -1);
  const auto faces = static_cast<Index>(refined.triangles.size() / 5);
  for (std::size_t v = 0; v + 1 < places.size(); ++v) {
    EXPECT_EQ(places[v].face / faces, static_cast<Index>(v / (many.points.size() / 5)));
    EXPECT_NEAR((surface.point(places[v]) - vec(many.points[v])).norm(), 0, 0.02);
  }
}

TEST(Locate, DoesNotDependOnThreads) {
  const TriangleMesh animal = builtin_shape("builtin:animal?n=3000");
  const Topology coarse = topology_of(animal);
  const Refinement fine = loop_refine(coarse);
  const std::vector<Point> points = combine(fine.stencils, animal.points);
  const SurfaceWalk surface(coarse, animal.points);
  const Topology from = make_topology(points.size(), fine.triangles);
  const std::vector<MeshPlace> places = locate(from, points, surface);
  for (int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(locate(from, points, SurfaceWalk(coarse, animal.points)), places);
  }
}

}  // namespace
}  // namespace pelage
