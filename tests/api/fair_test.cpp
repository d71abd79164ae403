#include <pelage/fair.h>
#include <pelage/io.h>

#include <cmath>

#include "api_support.h"

namespace pelage::api {
namespace {

/// A sphere of radius 1 with noise along its normals that repeats itself only by chance.
TriangleMesh noisy_sphere() {
  TriangleMesh mesh = load_shape("builtin:sphere?n=642");
  std::uint32_t state = 1;
  for (Point& p : mesh.points) {
    state = 1664525 * state + 1013904223;
    const double factor = 1 + 0.02 * (static_cast<double>(state) / 4294967296.0 - 0.5);
    for (double& x : p) x *= factor;
  }
  return mesh;
}

double roughness(const std::vector<Point>& points) {
  double mean = 0, square = 0;
  for (const Point& p : points) {
    const double r = std::hypot(p[0], p[1], p[2]);
    mean += r / static_cast<double>(points.size());
    square += r * r / static_cast<double>(points.size());
  }
  return std::sqrt(square - mean * mean);
}

TEST(Fair, EveryMethodTakesNoiseOffAndKeepsTheVolume) {
  const TriangleMesh mesh = noisy_sphere();
  for (const std::string& method : fair_methods()) {
    FairOptions options;
    options.method = method;
    const Faired faired = fair(mesh, options);
    EXPECT_LT(roughness(faired.mesh.points), 0.8 * roughness(mesh.points)) << method;
    EXPECT_NEAR(faired.report.volume_after / faired.report.volume_before, 1, 1e-9) << method;
    EXPECT_EQ(faired.mesh.triangles, mesh.triangles) << method;
  }
}

TEST(Fair, TheFunctionIsTheObjectToItsEnd) {
  const TriangleMesh mesh = noisy_sphere();
  Fairing first(mesh);
  Fairing fairing = std::move(first);
  while (!fairing.done()) fairing.step();
  const Faired faired = fair(mesh);
  EXPECT_EQ(fairing.points(), faired.mesh.points);
  EXPECT_EQ(fairing.report().steps, faired.report.steps);
}

TEST(Fair, AStateGoesOnWithTheSameBits) {
  const TriangleMesh mesh = noisy_sphere();
  FairOptions options;
  options.method = "isotropic";
  options.steps = 4;
  Fairing whole(mesh, options), first(mesh, options), second(mesh, options);
  for (int i = 0; i < 4; ++i) whole.step();
  for (int i = 0; i < 2; ++i) first.step();
  second.restore(first.state());
  while (!second.done()) second.step();
  EXPECT_EQ(second.report().steps, 4);
  EXPECT_EQ(second.points(), whole.points());
  EXPECT_EQ(fault_of([&] { second.restore({{{0, 0, 0}}, 1, false}); }), 2);
}

TEST(Fair, FaultsAndCancelling) {
  const TriangleMesh mesh = noisy_sphere();
  FairOptions options;
  options.method = "magic";
  EXPECT_EQ(fault_of([&] { fair(mesh, options); }), 2);
  int calls = 0;
  EXPECT_EQ(fault_of([&] { fair(mesh, {}, [&](std::string_view, double) { return ++calls < 2; }); }), 130);
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace pelage::api
