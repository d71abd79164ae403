#include "shape/isotropic_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/crease_lines.h"
#include "shape/creases.h"
#include "shape/generators.h"
#include "support/mesh_facts.h"
#include "verify/triangulations.h"

namespace pelage {
namespace {

using testing::vec;

TriangleMesh mesh_of(const IsotropicMesh& made) { return {made.points, made.topology.triangles, {}}; }

double mean_edge(const TriangleMesh& mesh) {
  double sum = 0, count = 0;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) sum += (vec(mesh.points[t[k]]) - vec(mesh.points[t[(k + 1) % 3]])).norm(), ++count;
  return sum / count;
}

/// The largest ratio of the diagonals of stiffness and lumped mass, which bounds explicit steps: 4 / h^2 at best.
double stiffest(const TriangleMesh& mesh) {
  std::vector<double> stiffness(mesh.points.size(), 0), mass(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int i = t[k], j = t[(k + 1) % 3], l = t[(k + 2) % 3];
      const Eigen::Vector3d u = vec(mesh.points[i]) - vec(mesh.points[l]),
                            v = vec(mesh.points[j]) - vec(mesh.points[l]);
      const double twice = u.cross(v).norm(), cotangent = u.dot(v) / twice;
      stiffness[i] += cotangent / 2;
      stiffness[j] += cotangent / 2;
      mass[l] += twice / 6;
    }
  double most = 0;
  for (std::size_t v = 0; v < mass.size(); ++v) most = std::max(most, stiffness[v] / mass[v]);
  return most;
}

void expect_places_hold(const IsotropicMesh& made, const TriangleMesh& base) {
  ASSERT_EQ(made.places.size(), made.points.size());
  for (std::size_t v = 0; v < made.points.size(); ++v) {
    const MeshPlace& place = made.places[v];
    EXPECT_GE(std::min(place.v, place.w), 0);
    EXPECT_LE(place.v + place.w, 1 + 1e-15);
    EXPECT_NEAR((vec(point_at(base.triangles, base.points, place)) - vec(made.points[v])).norm(), 0, 1e-12);
  }
}

TEST(IsotropicMesh, MakesAnyTriangulationOfASphereEven) {
  using enum SphereTriangulation;
  for (SphereTriangulation kind : {uniform, graded, slivers})
    for (double edge : {0.3, 0.1, 0.04}) {
      SCOPED_TRACE(edge);
      const TriangleMesh base = unit_sphere(kind, 2000);
      const IsotropicMesh made = isotropic_mesh(base.triangles, base.points, edge);
      const TriangleMesh mesh = mesh_of(made);
      const testing::MeshFacts facts = testing::mesh_facts(mesh);
      expect_places_hold(made, base);
      EXPECT_EQ(facts.euler, 2);
      EXPECT_TRUE(facts.closed);
      EXPECT_NEAR(facts.area, testing::mesh_facts(base).area, std::max(0.004, edge * edge / 3) * facts.area);
      EXPECT_NEAR(mean_edge(mesh), edge, 0.03 * edge);
      const double vertices = facts.area * 2 / std::sqrt(3.0) / (edge * edge);
      EXPECT_NEAR(static_cast<double>(mesh.points.size()), vertices, 0.03 * vertices + 6);
      EXPECT_GT(facts.shortest_edge, 0.5 * edge);
      EXPECT_GT(facts.smallest_angle, 25);
      EXPECT_LT(stiffest(mesh) * edge * edge, 14);
      EXPECT_GE(std::count(facts.valences.begin(), facts.valences.end(), 6), 0.7 * vertices);
      for (const Triangle& t : mesh.triangles) {
        const Eigen::Vector3d a = vec(mesh.points[t[0]]), b = vec(mesh.points[t[1]]), c = vec(mesh.points[t[2]]);
        EXPECT_GT((b - a).cross(c - a).dot(a + b + c), 0);
      }
    }
}

/// Circles of latitude around both poles, and a long tube: triangles of one to several hundred.
TriangleMesh revolution(int around, int along, double length) {
  TriangleMesh mesh;
  for (int j = 0; j <= along; ++j) {
    const double angle = M_PI * j / along;
    for (int i = 0; i < (j == 0 || j == along ? 1 : around); ++i) {
      const double u = 2 * M_PI * i / around;
      mesh.points.push_back({std::sin(angle) * std::cos(u), std::sin(angle) * std::sin(u), -length * std::cos(angle)});
    }
  }
  const auto at = [&](int i, int j) {
    return j == 0 ? 0 : j == along ? 1 + (along - 1) * around : 1 + (j - 1) * around + i % around;
  };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      if (j > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (j + 1 < along) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  for (Triangle& t : mesh.triangles)
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) t = {};
  std::erase(mesh.triangles, Triangle{});
  return mesh;
}

/// Limits that creep towards the length of all its edges would cut every one.
TEST(IsotropicMesh, LeavesAnEvenMeshThatIsALittleCoarse) {
  const TriangleMesh base = builtin_shape("builtin:sphere?n=2562");
  const double edge = mean_edge(base);
  for (double share : {0.85, 0.9, 0.95, 1.05}) {
    SCOPED_TRACE(share);
    const IsotropicMesh made = isotropic_mesh(base.triangles, base.points, share * edge);
    EXPECT_NEAR(mean_edge(mesh_of(made)), share * edge, 0.15 * edge);
    EXPECT_LT(stiffest(mesh_of(made)) * share * share * edge * edge, 10);
  }
}

TEST(IsotropicMesh, OnALevelWithManyMoreTrianglesItBeginsWithAnEarlierOne) {
  const TriangleMesh base = unit_sphere(SphereTriangulation::slivers, 1000);
  Hierarchy levels(make_topology(base.points.size(), base.triangles), midpoint_refine);
  levels.refine();
  levels.refine();
  const std::vector<Point> points = levels.refined(base.points, 0, 2);
  for (double edge : {0.3, 0.08}) {
    const IsotropicMesh made = isotropic_mesh(levels, points, std::vector<double>(points.size(), edge));
    expect_places_hold(made, {points, levels.topology(2).triangles, {}});
    const testing::MeshFacts facts = testing::mesh_facts(mesh_of(made));
    EXPECT_EQ(facts.euler, 2);
    EXPECT_NEAR(mean_edge(mesh_of(made)), edge, 0.04 * edge);
    EXPECT_GT(facts.smallest_angle, 22);
    EXPECT_LT(stiffest(mesh_of(made)) * edge * edge, 14);
  }
}

TEST(IsotropicMesh, StandsPolesAndSlivers) {
  for (const TriangleMesh& base : {revolution(300, 40, 1), revolution(12, 200, 1), revolution(100, 8, 5)}) {
    const IsotropicMesh made = isotropic_mesh(base.triangles, base.points, 0.15);
    const testing::MeshFacts facts = testing::mesh_facts(mesh_of(made)), before = testing::mesh_facts(base);
    expect_places_hold(made, base);
    EXPECT_EQ(facts.euler, 2);
    EXPECT_NEAR(facts.area, before.area, 0.02 * before.area);
    EXPECT_NEAR(facts.volume, before.volume, 0.03 * before.volume);
    EXPECT_LT(*std::max_element(facts.valences.begin(), facts.valences.end()), 10);
    EXPECT_LT(stiffest(mesh_of(made)) * 0.15 * 0.15, 20);
  }
}

/// The length of the boundary and the distance of its vertices from the square [0, 1]^2's.
TEST(IsotropicMesh, KeepsBoundariesAndTheirCorners) {
  const TriangleMesh plane = builtin_shape("builtin:plane?n=900");
  for (double edge : {0.15, 0.04, 0.013}) {
    const IsotropicMesh made = isotropic_mesh(plane.triangles, plane.points, edge);
    const Topology topology = make_topology(made.points.size(), made.topology.triangles);
    double length = 0;
    int corners = 0;
    for (Index h = 0; h < static_cast<Index>(topology.twin.size()); ++h) {
      if (topology.twin[static_cast<std::size_t>(h)] >= 0) continue;
      const Point &a = made.points[static_cast<std::size_t>(topology.origin(h))],
                  &b = made.points[static_cast<std::size_t>(topology.target(h))];
      length += (vec(b) - vec(a)).norm();
      EXPECT_NEAR(std::min({a[0], 1 - a[0], a[1], 1 - a[1]}), 0, 1e-12);
      corners += std::min(a[0], 1 - a[0]) < 1e-12 && std::min(a[1], 1 - a[1]) < 1e-12;
    }
    EXPECT_NEAR(length, 4, 1e-9);
    EXPECT_EQ(corners, 4);
    const testing::MeshFacts facts = testing::mesh_facts(mesh_of(made));
    EXPECT_NEAR(facts.area, 1, 1e-9);
    EXPECT_EQ(facts.euler, 1);
    EXPECT_NEAR(mean_edge(mesh_of(made)), edge, 0.05 * edge);
    EXPECT_GT(facts.shortest_edge, 0.4 * edge);
    expect_places_hold(made, plane);
    for (const Point& p : made.points) EXPECT_EQ(p[2], 0);
  }
}

TEST(IsotropicMesh, KeepsHolesAndStripsNarrowerThanEdges) {
  TriangleMesh strip;  // 10 x 0.05, wound once into a ring: two boundaries
  for (int i = 0; i < 60; ++i)
    for (double z : {0.0, 0.05}) strip.points.push_back({std::cos(i * M_PI / 30), std::sin(i * M_PI / 30), z});
  for (int i = 0; i < 120; i += 2) {
    strip.triangles.push_back({i, (i + 2) % 120, (i + 3) % 120});
    strip.triangles.push_back({i, (i + 3) % 120, i + 1});
  }
  const IsotropicMesh made = isotropic_mesh(strip.triangles, strip.points, 0.2);
  const testing::MeshFacts facts = testing::mesh_facts(mesh_of(made));
  EXPECT_EQ(facts.euler, 0);
  EXPECT_NEAR(facts.area, testing::mesh_facts(strip).area, 0.03 * facts.area);
  expect_places_hold(made, strip);
}

TEST(IsotropicMesh, KeepsComponentsSmallerThanAnEdge) {
  TriangleMesh base = unit_sphere(SphereTriangulation::uniform, 1000);
  const TriangleMesh torus = builtin_shape("builtin:torus?n=500");
  const auto first = static_cast<Index>(base.points.size());
  for (const Point& p : torus.points) base.points.push_back({3 + 0.01 * p[0], 0.01 * p[1], 0.01 * p[2]});
  for (const Triangle& t : torus.triangles) base.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  const IsotropicMesh made = isotropic_mesh(base.triangles, base.points, 0.2);
  const testing::MeshFacts facts = testing::mesh_facts(mesh_of(made));
  EXPECT_EQ(facts.euler, 2 + 0);
  EXPECT_TRUE(facts.closed);
  const auto small = std::count_if(made.points.begin(), made.points.end(), [](const Point& p) { return p[0] > 2; });
  EXPECT_GE(small, 7);  // no torus has fewer
  EXPECT_LE(small, 60);
}

TEST(IsotropicMesh, HasTheWantedSizesWithLimitedSlope) {
  const TriangleMesh base = unit_sphere(SphereTriangulation::uniform, 20000);
  std::vector<double> edges;
  for (const Point& p : base.points) edges.push_back(p[2] > 0.9 ? 0.05 : 0.3);
  const IsotropicMesh made = isotropic_mesh(base.triangles, base.points, edges);
  const auto wanted = [](const Point& p) {  // 0.3 per unit of length from the polar cap
    const double away = std::max(0.0, std::acos(std::clamp(p[2], -1.0, 1.0)) - std::acos(0.9));
    return std::min(0.3, 0.05 + 0.3 * away);
  };
  double sum = 0, count = 0;
  for (const Triangle& t : made.topology.triangles)
    for (int k = 0; k < 3; ++k) {
      const Point &a = made.points[t[k]], &b = made.points[t[(k + 1) % 3]];
      const double ratio = (vec(a) - vec(b)).norm() / ((wanted(a) + wanted(b)) / 2);
      EXPECT_GT(ratio, 0.4);
      EXPECT_LT(ratio, 2.1);
      sum += ratio;
      ++count;
    }
  EXPECT_NEAR(sum / count, 1, 0.06);
  EXPECT_GT(testing::mesh_facts(mesh_of(made)).smallest_angle, 20);
}

TEST(IsotropicMesh, DoesNotDependOnThreads) {
  const TriangleMesh animal = builtin_shape("builtin:animal?n=3000");
  const auto make = [&] { return isotropic_mesh(animal.triangles, animal.points, 0.03); };
  const IsotropicMesh made = make();
  EXPECT_EQ(testing::mesh_facts(mesh_of(made)).euler, 2);
  for (int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const IsotropicMesh again = make();
    EXPECT_EQ(again.topology.triangles, made.topology.triangles);
    EXPECT_EQ(again.points, made.points);
    EXPECT_EQ(again.places, made.places);
  }
}

TEST(IsotropicMesh, RefusesLengthsThatAreNotPositive) {
  const TriangleMesh base = unit_sphere(SphereTriangulation::uniform, 200);
  for (double edge : {0.0, -1.0, std::nan(""), 1e-9})
    EXPECT_THROW(isotropic_mesh(base.triangles, base.points, edge), Error);
}

/// A plate with a raised block whose corner is near the plate's own edge, turned so that nothing lies on planes to the
/// bit; between the creases there are needles alone.
TriangleMesh plate_with_a_block() {
  TriangleMesh mesh;
  const auto level = [&](double z, const std::array<std::array<double, 2>, 4>& corners) {
    for (const auto& [x, y] : corners) {
      const double u = std::cos(0.3) * x - std::sin(0.3) * y, v = std::sin(0.3) * x + std::cos(0.3) * y;
      const Point p = {u, std::cos(0.3) * v - std::sin(0.3) * z, std::sin(0.3) * v + std::cos(0.3) * z};
      mesh.points.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
  };
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  level(0, {{{0, 0}, {5, 0}, {5, 2.5}, {0, 2.5}}});
  level(0.5, {{{0, 0}, {5, 0}, {5, 2.5}, {0, 2.5}}});
  level(0.5, {{{0.04, 0.04}, {4, 0.7}, {4.2, 2}, {0.6, 2.2}}});
  level(0.7, {{{0.04, 0.04}, {4, 0.7}, {4.2, 2}, {0.6, 2.2}}});
  quad(3, 2, 1, 0);
  for (Index below = 0; below < 12; below += 4)
    for (Index i = 0; i < 4; ++i) {
      const Index j = (i + 1) % 4;
      quad(below + i, below + j, below + 4 + j, below + 4 + i);
    }
  quad(12, 13, 14, 15);
  return mesh;
}

/// How many triangles have corners in several of the regions between creases.
int triangles_over_creases(const IsotropicMesh& made, const Topology& base) {
  const std::vector<Index> region = smooth_regions(base);
  VertexRing around;
  int count = 0;
  for (const Triangle& t : made.topology.triangles) {
    std::set<Index> regions;
    for (const Index v : t) {
      vertex_ring(made.topology, v, around);
      if (around.sharp.empty()) regions.insert(region[made.places[v].face]);
    }
    count += regions.size() > 1;
  }
  return count;
}

/// Edges beside creases are cut on their own side, and those that cannot be are no cause to cut others for ever.
TEST(IsotropicMesh, IsEvenBetweenCloseCreases) {
  const TriangleMesh plate = plate_with_a_block();
  Topology t = make_topology(plate.points.size(), plate.triangles);
  t.creases = creases_above(40, t, plate.points);
  Hierarchy levels(t, loop_refine);
  std::vector<Point> points = plate.points;
  for (int level = 0; level < 6; ++level) {
    levels.refine();
    points = levels.refined(std::move(points), level, level + 1);
  }
  const std::vector<Point> limit = loop_limits(levels.topology(6), points);
  for (const double edge : {0.08, 0.04}) {
    SCOPED_TRACE(edge);
    const IsotropicMesh made = isotropic_mesh(levels, limit, std::vector<double>(limit.size(), edge));
    const testing::MeshFacts facts = testing::mesh_facts(mesh_of(made));
    const double wanted = 2 / std::sqrt(3.0) * facts.area / (edge * edge);
    EXPECT_NEAR(static_cast<double>(made.points.size()) / wanted, 1, 0.06);
    EXPECT_LT(facts.longest_edge, 2 * edge);
    EXPECT_EQ(triangles_over_creases(made, levels.topology(6)), 0);
  }
}

}  // namespace
}  // namespace pelage
