#include "shape/own_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shape/generators.h"
#include "shape/isotropic_mesh.h"
#include "shape/vectors.h"
#include "support/reordered.h"

namespace pelage {
namespace {

using testing::placed;
using testing::reordered;

constexpr const char* shapes[] = {"builtin:sphere?n=642", "builtin:cube?n=300", "builtin:plane?n=400",
                                  "builtin:torus?n=700", "builtin:animal?n=1500"};

/// Two of them, of which the second is smaller.
TriangleMesh with_a_second(TriangleMesh mesh) {
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  const TriangleMesh other = placed(mesh, 0.5, {5, 0.3, -0.2});
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  return mesh;
}

OwnOrder order_of(const TriangleMesh& mesh) {
  return own_order(make_topology(mesh.points.size(), mesh.triangles), mesh.points);
}

TEST(OwnOrder, IsTheSameWhateverTheNumbers) {
  for (const char* name : shapes) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = with_a_second(builtin_shape(name)), other = reordered(mesh, 3).mesh;
    const OwnOrder one = order_of(mesh), two = order_of(other);
    EXPECT_EQ(one.topology.triangles, two.topology.triangles);
    EXPECT_EQ(one.topology.twin, two.topology.twin);
    ASSERT_EQ(one.vertex.size(), mesh.points.size());
    for (std::size_t v = 0; v < one.vertex.size(); ++v)
      ASSERT_EQ(mesh.points[static_cast<std::size_t>(one.vertex[v])],
                other.points[static_cast<std::size_t>(two.vertex[v])]);
  }
}

TEST(OwnOrder, HoldsTheTrianglesOfTheMesh) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=1500");
  const OwnOrder order = order_of(mesh);
  const Topology made = make_topology(mesh.points.size(), order.topology.triangles);
  EXPECT_EQ(made.twin, order.topology.twin);
  EXPECT_EQ(made.outgoing, order.topology.outgoing);
  std::vector<Triangle> named;
  for (Triangle t : order.topology.triangles) {
    for (auto& v : t) v = order.vertex[static_cast<std::size_t>(v)];
    named.push_back(t);
  }
  const auto turned = [](std::vector<Triangle> list) {
    for (Triangle& t : list) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(list.begin(), list.end());
    return list;
  };
  EXPECT_EQ(turned(named), turned(mesh.triangles));
}

TEST(OwnOrder, WithoutSymmetryPointsStayNear) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  const std::vector<Point> moved = without_symmetry(mesh.points, 0.1);
  for (std::size_t v = 0; v < moved.size(); ++v) {
    EXPECT_LT(length(difference(moved[v], mesh.points[v])), 1e-6);
    EXPECT_GT(length(difference(moved[v], mesh.points[v])), 0);
  }
}

/// The mesh of a run: the same triangles, and the same points to rounding, wherever the shape lies, however large it is
/// and whatever the order of its file. Symmetric shapes are the hard ones, since all their comparisons are ties.
void expect_same_remeshing(const TriangleMesh& mesh, const TriangleMesh& other, double scale, const Point& offset,
                           double edge, double tolerance) {
  const IsotropicMesh one = isotropic_mesh(mesh.triangles, mesh.points, edge),
                      two = isotropic_mesh(other.triangles, other.points, edge * scale);
  EXPECT_TRUE(one.topology.triangles == two.topology.triangles);
  ASSERT_EQ(one.points.size(), two.points.size());
  double most = 0;
  for (std::size_t v = 0; v < one.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k)
      most = std::max(most, std::abs(one.points[v][k] + offset[k] / scale - two.points[v][k] / scale));
  EXPECT_LT(most, tolerance);
}

TEST(OwnOrder, RemeshingDoesNotDependOnThePlace) {
  for (const char* name : shapes)
    for (const double edge : {0.3, 0.06}) {
      SCOPED_TRACE(name + std::to_string(edge));
      const TriangleMesh mesh = builtin_shape(name);
      const auto expect_same = [&](const char* what, const TriangleMesh& other, double scale, const Point& offset,
                                   double tolerance) {
        SCOPED_TRACE(what);
        expect_same_remeshing(mesh, other, scale, offset, edge, tolerance);
      };
      const Point aside = {10, -3, 0.1}, utm = {431250, 5412875, 310};
      for (const unsigned seed : {1U, 2U}) expect_same("shuffled", reordered(mesh, seed).mesh, 1, {}, 1e-6);
      expect_same("moved", placed(mesh, 1, aside), 1, aside, 1e-6);
      expect_same("in millimetres", placed(mesh, 1000, {}), 1000, {}, 1e-6);
      expect_same("georeferenced", placed(mesh, 1, utm), 1, utm, 1e-6);
    }
}

}  // namespace
}  // namespace pelage
