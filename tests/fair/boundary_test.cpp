#include "fair/boundary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fair/noisy.h"
#include "pelage/fair.h"

namespace pelage {
namespace {

TEST(Boundary, StaysOrSlidesAlongItself) {
  const TriangleMesh truth = builtin_shape("builtin:plane?n=400");
  const Topology topology = make_topology(truth.points.size(), truth.triangles);
  TriangleMesh noisy = testing::with_noise_everywhere(truth, 0.2);
  const auto at_limit = [](double x) { return x < 1e-9 || x > 1 - 1e-9; };
  for (std::size_t v = 0; v < truth.points.size(); ++v) {
    if (!topology.on_boundary(static_cast<Index>(v))) continue;
    const Point &p = truth.points[v], shifted = noisy.points[v];
    noisy.points[v] = p;
    const bool x = at_limit(p[0]), y = at_limit(p[1]);
    if (x && y) continue;
    noisy.points[v][x ? 1 : 0] = shifted[x ? 1 : 0];  // noise along the boundary only
  }
  for (const std::string& method : fair_methods()) {
    const TriangleMesh still = fair(noisy, {.method = method, .steps = 3}).mesh;
    const TriangleMesh slid = fair(noisy, {.method = method, .steps = 3, .slide = true}).mesh;
    double way = 0;
    for (std::size_t v = 0; v < truth.points.size(); ++v) {
      if (!topology.on_boundary(static_cast<Index>(v))) continue;
      EXPECT_EQ(still.points[v], noisy.points[v]) << method;
      const std::size_t limit = at_limit(truth.points[v][0]) ? 0 : 1;
      EXPECT_NEAR(slid.points[v][limit], truth.points[v][limit], 1e-12) << method;
      EXPECT_NEAR(slid.points[v][2], truth.points[v][2], 1e-12) << method;
      for (std::size_t k = 0; k < 3; ++k) way += std::abs(slid.points[v][k] - noisy.points[v][k]);
    }
    EXPECT_GT(way, 1e-3) << method;
  }
}

TEST(Boundary, CornersAreFoundAndNeighboursCannotPass) {
  const TriangleMesh plane = builtin_shape("builtin:plane?n=100");
  const Topology topology = make_topology(plane.points.size(), plane.triangles);
  const BoundaryRails rails(topology, plane.points);
  int corners = 0;
  for (char c : rails.corner()) corners += c;
  EXPECT_EQ(corners, 4);
  std::vector<Point> far = plane.points;
  for (Point& p : far) p[0] += 10;  // every vertex as far to one side as its rail goes
  rails.put_back(far);
  const double h = testing::mean_edge(plane);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (!topology.on_boundary(v)) continue;
    EXPECT_LT((vector3(far[v]) - vector3(plane.points[v])).norm(), h) << v;
  }
}

}  // namespace
}  // namespace pelage
