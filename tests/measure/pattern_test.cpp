#include "measure/pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "pelage/error.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using std::numbers::pi;

/// The square [0, 1] x [0, 1] in a plane.
TriangleMesh square(int n) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.push_back({double(i) / n, double(j) / n, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j, b = a + 1, c = b + n + 1, d = a + n + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

PatternMeasures measured(const TriangleMesh& mesh, const std::function<double(const Point&)>& u,
                         const std::optional<double>& level = {}) {
  std::vector<double> values;
  for (const Point& p : mesh.points) values.push_back(u(p));
  return measure_pattern(mesh, values, level);
}

TEST(Pattern, StripesOfAPlaneWave) {
  const PatternMeasures m = measured(square(120), [](const Point& p) { return 3 + std::cos(2 * pi * 5 * p[0]); });
  EXPECT_NEAR(m.area, 1, 1e-12);
  EXPECT_NEAR(m.mean, 3, 1e-6);
  EXPECT_NEAR(m.deviation, std::sqrt(0.5), 5e-3);
  EXPECT_NEAR(m.level, 3, 1e-2);
  EXPECT_EQ(m.above.parts, 6U);  // half ones at both ends
  EXPECT_EQ(m.below.parts, 5U);
  EXPECT_NEAR(m.below.share, 0.5, 1e-3);
  EXPECT_NEAR(m.border, 10, 1e-3);
  EXPECT_NEAR(m.below.width, 0.1, 1e-3);
  EXPECT_NEAR(m.wavelength, 0.2, 2e-3);
  EXPECT_NEAR(m.coherence, 1, 1e-9);
  EXPECT_NEAR(m.along[1], 1, 1e-9);
}

TEST(Pattern, ObliqueStripesInSpace) {
  const auto turned = [](TriangleMesh mesh) {
    for (Point& p : mesh.points) p = {p[2] + 7, p[0], p[1]};  // the plane of y and z
    return mesh;
  };
  const PatternMeasures m =
      measured(turned(square(120)), [](const Point& p) { return std::cos(2 * pi * (4 * p[1] + 3 * p[2])); });
  EXPECT_NEAR(m.wavelength, 0.2, 2e-3);
  EXPECT_NEAR(m.along[0], 0, 1e-12);
  EXPECT_NEAR(m.along[1], 0.36, 0.01);
  EXPECT_NEAR(m.along[2], 0.64, 0.01);
  EXPECT_GT(m.coherence, 0.97);
}

/// Three plane waves at 60 degrees: maxima in triangles, at 2/3^(1/2) wavelengths from each other.
TEST(Pattern, SpotsOfThreeWaves) {
  const double k = 2 * pi * 12;
  const PatternMeasures m = measured(
      square(150),
      [&](const Point& p) {
        return std::cos(k * p[0]) + std::cos(k * (-p[0] / 2 + std::numbers::sqrt3 / 2 * p[1])) +
               std::cos(k * (-p[0] / 2 - std::numbers::sqrt3 / 2 * p[1]));
      },
      1.0);
  const double wavelength = 1.0 / 12, spacing = 2 / std::numbers::sqrt3 * wavelength;
  EXPECT_NEAR(m.wavelength / wavelength, 1, 0.02);
  EXPECT_NEAR(m.spacing / spacing, 1, 0.1);  // spots at the border count as whole ones
  EXPECT_LT(m.coherence, 0.2);
  EXPECT_EQ(m.below.parts, 1U);
}

TEST(Pattern, DiscsHaveTheirAreaAndWidth) {
  const PatternMeasures m = measured(
      square(90), [](const Point& p) { return 0.3 - std::hypot(p[0] - 0.5, p[1] - 0.5); }, 0.0);
  EXPECT_EQ(m.above.parts, 1U);
  EXPECT_NEAR(m.above.share, pi * 0.09, 6e-4);
  EXPECT_NEAR(m.border, 2 * pi * 0.3, 2e-3);
  EXPECT_NEAR(m.above.width, 0.3, 1e-3);
}

/// Of z on the unit sphere the mean square is 1/3 and that of the slope 2/3; the zones run around the axis.
TEST(Pattern, ZonesOfASphere) {
  const PatternMeasures m = measured(
      builtin_shape("builtin:sphere?n=2562"), [](const Point& p) { return p[1]; }, 0.0);
  EXPECT_NEAR(m.wavelength, 2 * pi / std::sqrt(2.0), 0.02);
  EXPECT_NEAR(m.border, 2 * pi, 1e-2);
  EXPECT_NEAR(m.above.share, 0.5, 1e-3);
  EXPECT_NEAR(m.along[1], 0, 1e-3);
  EXPECT_NEAR(m.along[0], 0.5, 1e-2);
}

/// With everything that was found beside: one line in the spectrum, no defects between the poles.
TEST(Pattern, ZonesHaveTheirSpectrumAndDefects) {
  const PatternMeasures m = measured(builtin_shape("builtin:sphere?n=10242"), [](const Point& p) {
    const double z = p[1];
    return (231 * std::pow(z, 6) - 315 * std::pow(z, 4) + 105 * z * z - 5) / 16;  // of degree 6
  });
  EXPECT_NEAR(2 * pi / m.spectrum.peak(), 2 * pi / std::sqrt(42.0), 0.01);
  EXPECT_NEAR(m.wavelength, 2 * pi / std::sqrt(42.0), 0.01);
  EXPECT_EQ(static_cast<int>(m.defects.plus) - static_cast<int>(m.defects.minus), 4);
  EXPECT_EQ(m.spots.count, m.above.parts);
}

TEST(Pattern, AConstantHasNone) {
  const PatternMeasures m = measured(square(10), [](const Point&) { return 2.0; });
  EXPECT_EQ(m.wavelength, 0);
  EXPECT_EQ(m.border, 0);
  EXPECT_EQ(m.above.parts + m.below.parts, 1U);
  EXPECT_EQ(m.coherence, 0);
}

TEST(Pattern, NothingToMeasureIsRefused) {
  EXPECT_THROW(measure_pattern({}, {}), Error);
  TriangleMesh flat = square(2);
  for (Point& p : flat.points) p = {};
  EXPECT_THROW(measured(flat, [](const Point&) { return 1.0; }), Error);
}

}  // namespace
}  // namespace pelage
