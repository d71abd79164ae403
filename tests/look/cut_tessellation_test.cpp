// Borders of layers are smooth below the size of a triangle.

#include "look/cut_tessellation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "look/dress.h"
#include "shape/edges.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

constexpr double border = 0.31;

/// A sphere on which the species u is the height.
Tessellation sphere() {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  Tessellation t;
  t.triangles = mesh.triangles;
  t.samples.position = t.samples.normal = mesh.points;
  t.samples.fields.resize(1);
  for (const Point& p : mesh.points) t.samples.fields[0].push_back(p[2]);
  return t;
}

Paint black_above_white(const std::string& opacity) {
  Look look;
  look.layers.resize(2);
  look.layers[0].color = {"#ffffff", {}};
  look.layers[1].color = {"#000000", {}};
  look.layers[1].opacity = {opacity, {}};
  return resolve_paint(look, {"u"});
}

/// Where what is drawn is half white along edges: the largest and the mean distance from the border, in edges.
std::pair<double, double> roughness(const Tessellation& t, const Paint& paint) {
  const TriangleMesh coat = dress(t, paint, {0});
  const std::vector<double>& color = coat.find("color")->values;
  const double edge = std::sqrt(4 / std::sqrt(3.0) * 4 * std::numbers::pi / 5120);
  double most = 0, sum = 0;
  int count = 0;
  for (const Triangle& triangle : coat.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(triangle[k]), b = static_cast<std::size_t>(triangle[(k + 1) % 3]);
      const double x = color[3 * a] - 0.5, y = color[3 * b] - 0.5;
      if ((x > 0) == (y > 0)) continue;
      const double z = coat.points[a][2] + x / (x - y) * (coat.points[b][2] - coat.points[a][2]);
      const double away = std::abs(std::asin(z) - std::asin(border)) / edge;
      most = std::max(most, away);
      sum += away;
      ++count;
    }
  EXPECT_GT(count, 100);
  return {most, sum / count};
}

class SharpLayer : public testing::TestWithParam<const char*> {};

TEST_P(SharpLayer, IsSmoothBelowTheSizeOfATriangle) {
  const Paint paint = black_above_white(GetParam());
  const auto [most_before, mean_before] = roughness(sphere(), paint);
  EXPECT_GT(most_before, 0.3);
  EXPECT_GT(mean_before, 0.15);
  const auto [most, mean] = roughness(cut_along_layers(sphere(), paint), paint);
  EXPECT_LT(most, 0.08);
  EXPECT_LT(mean, 0.02);
}

INSTANTIATE_TEST_SUITE_P(All, SharpLayer, testing::Values("u > 0.31", "smoothstep(0.3095, 0.3105, u)"),
                         [](const auto& test) { return test.index == 0 ? "Step" : "Ramp"; });

/// A vertex within the ramp may not glow amid those that are past it.
TEST(CutAlongLayers, LeavesNoSpecks) {
  const Paint paint = black_above_white("smoothstep(0.3, 0.32, u)");
  const Tessellation t = cut_along_layers(sphere(), paint);
  const TriangleMesh coat = dress(t, paint, {0});
  const std::vector<double>& color = coat.find("color")->values;
  for (const Triangle& triangle : coat.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(triangle[k]), b = static_cast<std::size_t>(triangle[(k + 1) % 3]);
      const double middle = (coat.points[a][2] + coat.points[b][2]) / 2;
      const double s = std::clamp((middle - 0.3) / 0.02, 0.0, 1.0), white = 1 - s * s * (3 - 2 * s);
      EXPECT_NEAR((color[3 * a] + color[3 * b]) / 2, white, 0.15);
    }
}

TEST(CutAlongLayers, LeavesGentleFadesAlone) {
  const Paint paint = black_above_white("smoothstep(-1, 1, u)");
  EXPECT_EQ(cut_along_layers(sphere(), paint).triangles, sphere().triangles);
}

}  // namespace
}  // namespace pelage
