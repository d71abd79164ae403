#include "discretise/surface_evaluator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "discretise/method.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

/// A shape refined so often, with its three coordinates as fields.
struct Refined {
  Hierarchy hierarchy;
  std::shared_ptr<const Space> space;
  Refined(const Method& method, const TriangleMesh& mesh, int levels)
      : hierarchy(make_topology(mesh.points.size(), mesh.triangles), method.refine) {
    for (int level = 0; level < levels; ++level) hierarchy.refine();
    space = method.make_space(hierarchy.shared_topology(levels), hierarchy.refined(mesh.points, 0, levels));
  }
  SurfaceEvaluator evaluator() const {
    std::vector<std::vector<double>> coordinates(3);
    for (const Point& p : space->control())
      for (std::size_t k = 0; k < 3; ++k) coordinates[k].push_back(p[k]);
    return SurfaceEvaluator(space, hierarchy.finest(), coordinates);
  }
};

class EveryMethod : public ::testing::TestWithParam<const Method*> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, ::testing::Values(&loop_method, &linear_method),
                         [](const auto& method) { return std::string(method.param->name); });

void expect_near(const Point& a, const Point& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance);
}

/// Another way to the same points: the limit masks of the mesh and of its refinement. (Extraordinary corners are
/// evaluated 2^-40 beside them.)
TEST_P(EveryMethod, CornersAndMiddlesOfEdgesAreVerticesOfTheRefinedMeshes) {
  for (const char* spec : {"builtin:animal?n=300", "builtin:plane?n=100"}) {
    const TriangleMesh mesh = builtin_shape(spec);
    const Refined coarse(*GetParam(), mesh, 0), fine(*GetParam(), mesh, 1);
    const PlaceGeometry vertices = fine.space->geometry(SampleRule::vertices, false);
    const Topology& t = coarse.hierarchy.topology(0);
    const SurfaceEvaluator evaluator = coarse.evaluator();
    for (Index f = 0; f < static_cast<Index>(t.triangles.size()); f += 7) {
      const auto [a, b, c] = t.triangles[static_cast<std::size_t>(f)];
      expect_near(evaluator.at(f, 0, 0).position, vertices.position[static_cast<std::size_t>(a)], 1e-11);
      expect_near(evaluator.at(f, 1, 0).position, vertices.position[static_cast<std::size_t>(b)], 1e-11);
      expect_near(evaluator.at(f, 0, 1).position, vertices.position[static_cast<std::size_t>(c)], 1e-11);
      const auto middle = static_cast<std::size_t>(t.vertex_count + t.edge[static_cast<std::size_t>(3 * f + 1)]);
      const SurfaceSample sample = evaluator.at(f, 0.5, 0.5);
      expect_near(sample.position, vertices.position[middle], 1e-11);
      if (GetParam()->smooth) expect_near(sample.normal, vertices.normal[middle], 1e-9);
    }
  }
}

/// Refinement changes neither the surface nor the place of (face, v, w) on it.
TEST_P(EveryMethod, PlacesDoNotKnowOfTheLevels) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=300");
  const Refined coarse(*GetParam(), mesh, 0), fine(*GetParam(), mesh, 3);
  const SurfaceEvaluator a = coarse.evaluator(), b = fine.evaluator();
  for (Index k = 0; k < 300; ++k) {
    const auto face = static_cast<Index>(static_cast<std::size_t>(k) * 7 % mesh.triangles.size());
    double v = uniform(1, static_cast<std::uint64_t>(k)), w = uniform(2, static_cast<std::uint64_t>(k));
    if (v + w > 1) v = 1 - v, w = 1 - w;
    expect_near(a.at(face, v, w).position, b.at(face, v, w).position, 1e-11);
    expect_near(a.at(face, v, w).normal, b.at(face, v, w).normal, 1e-7);
  }
}

/// Of the coordinates: values are positions, and gradients e_k - n_k n.
TEST_P(EveryMethod, ValuesAndGradientsOfCoordinates) {
  const Refined animal(*GetParam(), builtin_shape("builtin:animal?n=300"), 1);
  const SurfaceEvaluator evaluator = animal.evaluator();
  for (Index k = 0; k < 200; ++k) {
    const double v = 0.01 + 0.48 * uniform(3, static_cast<std::uint64_t>(k)),
                 w = 0.01 + 0.48 * uniform(4, static_cast<std::uint64_t>(k));
    const SurfaceSample s = evaluator.at(k, v, w);
    EXPECT_NEAR(length(s.normal), 1, 1e-12);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(s.values[i], s.position[i], 1e-13);
      for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(s.gradients[i][j], (i == j ? 1 : 0) - s.normal[i] * s.normal[j], 1e-9);
    }
  }
}

}  // namespace
}  // namespace pelage
