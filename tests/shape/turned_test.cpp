#include "shape/turned.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace pelage {
namespace {

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

/// Every edge has one triangle on each side, which go along it in opposite directions.
bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> ways;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++ways[{t[k], t[(k + 1) % 3]}];
  for (const auto& [way, count] : ways)
    if (count != 1 || !ways.contains({way.second, way.first})) return false;
  return true;
}

/// Half a circle becomes a sphere, whichever way it is drawn.
TEST(Turned, HalfACircleIsASphere) {
  std::vector<std::array<double, 2>> arc;
  for (int i = 0; i <= 40; ++i)
    arc.push_back({i % 40 == 0 ? 0 : std::sin(std::numbers::pi * i / 40), -std::cos(std::numbers::pi * i / 40)});
  for (const bool down : {false, true}) {
    if (down) std::ranges::reverse(arc);
    const TriangleMesh mesh = turned_shape(arc, 2000);
    EXPECT_NEAR(static_cast<double>(mesh.points.size()), 2000, 200);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(static_cast<int>(mesh.points.size()) * 2 - 4, static_cast<int>(mesh.triangles.size()));
    EXPECT_NEAR(volume(mesh), 4 * std::numbers::pi / 3, 0.05);
  }
}

/// A glass has an inside: its walls are all that it is made of.
TEST(Turned, AGlassIsHollow) {
  const TriangleMesh glass = turned_shape({{0, 0}, {0.5, 0}, {0.5, 1}, {0.45, 1}, {0.45, 0.05}, {0, 0.05}}, 4000);
  EXPECT_TRUE(is_closed(glass));
  EXPECT_LT(volume(glass), 0.3 * std::numbers::pi * 0.25);
  EXPECT_GT(volume(glass), 0.05 * std::numbers::pi * 0.25);
}

}  // namespace
}  // namespace pelage
