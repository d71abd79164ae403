// Of volumes that fill surfaces: shape/tet_places.

#include "shape/tet_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "shape/generators.h"
#include "shape/vectors.h"
#include "solid/fill.h"

namespace pelage {
namespace {

double f(const Point& p) { return 1 + 2 * p[0] - p[1] + 0.5 * p[2]; }

double value(const TetMesh& volume, const TetPlace& place) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += place.share[k] * f(volume.points[static_cast<std::size_t>(place.node[k])]);
  return sum;
}

TEST(TetPlaces, LinearFunctionsAreExactInside) {
  const TetMesh volume = fill(builtin_shape("builtin:sphere?n=500"), 0.17, 1'000'000).volume;
  std::vector<Point> places;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.61803398875 * i, r = 0.9 * std::cbrt(i / 4000.0);
    const double z = std::fmod(0.754877666 * i, 2.0) - 1;
    places.push_back(
        {r * std::sqrt(1 - z * z) * std::cos(6.28 * t), r * std::sqrt(1 - z * z) * std::sin(6.28 * t), r * z});
  }
  places.insert(places.end(), volume.points.begin(), volume.points.end());
  const std::vector<TetPlace> found = places_in(volume, places);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(value(volume, found[i]), f(places[i]), 1e-9);
}

/// The corner of a cube is cut off: there the nearest place of the skin counts, and no node counts negatively.
TEST(TetPlaces, OutsideTheNearestPlaceCounts) {
  const TetMesh volume = fill(builtin_shape("builtin:cube"), 0.2, 1'000'000).volume;
  for (const TetPlace& place : places_in(volume, {{5, 0.1, 0.2}, {1, 1, 1}, {-1, -1, -1}, {0.3, 1e9, 0}})) {
    double sum = 0;
    for (const double s : place.share) {
      EXPECT_GE(s, -1e-9);
      sum += s;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(TetPlaces, ThreadsDoNotMatter) {
  const TriangleMesh shape = builtin_shape("builtin:sphere?n=500");
  const TetMesh volume = fill(shape, 0.2, 1'000'000).volume;
  const std::vector<TetPlace> all = places_in(volume, shape.points);
  const ThreadLimit one(1);
  const std::vector<TetPlace> again = places_in(volume, shape.points);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].node, again[i].node);
    EXPECT_EQ(all[i].share, again[i].share);
  }
}

}  // namespace
}  // namespace pelage
