#include "look/coat_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pelage/error.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using std::numbers::pi;

/// A mesh with one species.
Tessellation tessellation(const TriangleMesh& mesh, const std::function<double(const Point&)>& u) {
  Tessellation t;
  t.triangles = mesh.triangles;
  t.samples.position = mesh.points;
  for (const Point& p : mesh.points) {
    t.samples.normal.push_back(p);  // of spheres
    t.samples.fields.resize(1);
    t.samples.fields[0].push_back(u(p));
  }
  t.attributes = mesh.attributes;
  return t;
}

Paint paint_of(Look look = {}) { return resolve_paint(look, {"u"}); }

std::vector<CoatLines> lines_of(const Tessellation& t, const std::vector<std::string>& texts) {
  std::vector<Isoline> isolines;
  for (const std::string& text : texts) isolines.push_back(parse_isoline(text, {"u"}));
  return coat_lines(isolines, with_isolines(paint_of(), isolines), t, {0});
}

template <class Place>
double length_of(const Line<Place>& line) {
  double sum = 0;
  const std::size_t n = line.points.size();
  for (std::size_t i = line.closed ? 0 : 1; i < n; ++i) {
    double square = 0;
    for (std::size_t d = 0; d < line.points[i].size(); ++d)
      square += std::pow(line.points[i][d] - line.points[(i + n - 1) % n][d], 2);
    sum += std::sqrt(square);
  }
  return sum;
}

/// Enclosed, by the rule that holes turn the other way.
double area_of(const std::vector<Line<PlanePoint>>& region) {
  double sum = 0;
  for (const auto& line : region)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const PlanePoint &p = line.points[i], &q = line.points[(i + 1) % line.points.size()];
      sum += (p[0] * q[1] - p[1] * q[0]) / 2;
    }
  return sum;
}

Tessellation sphere(const std::function<double(const Point&)>& u) {
  return tessellation(builtin_shape("builtin:sphere?n=10242"), u);
}

TEST(CoatLines, ACircleInSpaceAndInAView) {
  const Tessellation t = sphere([](const Point& p) { return p[2]; });
  const auto lines = lines_of(t, {"u = 0.6"});
  const auto in_space = lines_in_space(t, lines);
  ASSERT_EQ(in_space[0].lines.size(), 1U);
  EXPECT_NEAR(length_of(in_space[0].lines[0]), 2 * pi * 0.8, 3e-3);
  const LineDrawing front = lines_in_view(t, lines, LineView::front, UpAxis::y, 50);
  ASSERT_EQ(front.parts.size(), 2U);
  ASSERT_EQ(front.parts[1].lines.size(), 1U);
  EXPECT_TRUE(front.parts[1].lines[0].closed);
  EXPECT_NEAR(length_of(front.parts[1].lines[0]), 2 * pi * 40, 0.15);
  EXPECT_NEAR(area_of(front.parts[1].region), pi * 1600, 5);
  EXPECT_NEAR(front.high[0] - front.low[0], 100, 0.01);
  ASSERT_EQ(front.parts[0].lines.size(), 1U);  // the outline of the sphere
  EXPECT_NEAR(length_of(front.parts[0].lines[0]), 2 * pi * 50, 0.05);
}

TEST(CoatLines, TheBackIsNotDrawn) {
  const Tessellation t = sphere([](const Point& p) { return p[2]; });
  const auto lines = lines_of(t, {"u < -0.6"});
  const LineDrawing front = lines_in_view(t, lines, LineView::front, UpAxis::y, 1);
  EXPECT_TRUE(front.parts[1].lines.empty());
  EXPECT_TRUE(front.parts[1].region.empty());
  const LineDrawing back = lines_in_view(t, lines, LineView::back, UpAxis::y, 1);
  EXPECT_NEAR(area_of(back.parts[1].region), pi * 0.64, 3e-3);
  const LineDrawing below = lines_in_view(t, lines, LineView::front, UpAxis::z, 1);  // from -y: half of the zone
  ASSERT_EQ(below.parts[1].lines.size(), 1U);
  EXPECT_FALSE(below.parts[1].lines[0].closed);
  EXPECT_NEAR(length_of(below.parts[1].lines[0]), 1.6, 3e-3);
}

/// Where each of the views puts the axes.
TEST(CoatLines, ViewsLookAlongTheAxes) {
  const struct {
    LineView view;
    Point right, up;
  } cases[] = {{LineView::front, {1, 0, 0}, {0, 1, 0}},  {LineView::back, {-1, 0, 0}, {0, 1, 0}},
               {LineView::right, {0, 0, -1}, {0, 1, 0}}, {LineView::left, {0, 0, 1}, {0, 1, 0}},
               {LineView::top, {1, 0, 0}, {0, 0, -1}},   {LineView::bottom, {1, 0, 0}, {0, 0, 1}}};
  for (const auto& c : cases) {
    const Tessellation t = sphere([&](const Point& p) {  // a spot on the seen side, up and to the right of the middle
      double square = 0;
      for (std::size_t d = 0; d < 3; ++d) square += p[d] * (0.6 * c.right[d] + 0.3 * c.up[d]);
      return square;
    });
    const LineDrawing d = lines_in_view(t, lines_of(t, {"u = 0.6"}), c.view, UpAxis::y, 1);
    double x = 0, y = 0, n = 0;
    for (const auto& line : d.parts[1].region)
      for (const PlanePoint& p : line.points) x += p[0], y += p[1], ++n;
    ASSERT_GT(n, 0);
    EXPECT_GT(x / n, 1.5);
    EXPECT_GT(y / n, 1.2);
  }
}

/// A small sphere before a large one: its shadow is a hole with the right border.
TEST(CoatLines, WhatIsBehindIsHidden) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=10242");
  const std::size_t n = mesh.points.size(), m = mesh.triangles.size();
  for (std::size_t v = 0; v < n; ++v) {
    const Point p = mesh.points[v];
    mesh.points.push_back({p[0] / 4, p[1] / 4, p[2] / 4 + 2});
  }
  for (std::size_t f = 0; f < m; ++f) {
    Triangle t = mesh.triangles[f];
    for (auto& v : t) v += static_cast<std::int32_t>(n);
    mesh.triangles.push_back(t);
  }
  Tessellation t = tessellation(mesh, [](const Point& p) { return p[2] > 1.5 ? -1.0 : 1.0; });
  for (std::size_t v = n; v < 2 * n; ++v) t.samples.normal[v] = t.samples.normal[v - n];
  t.samples.fields[0][0] = -1;  // a line somewhere, for the large sphere's region
  const LineDrawing d = lines_in_view(t, lines_of(t, {"u = 0"}), LineView::front, UpAxis::y, 1);
  EXPECT_NEAR(area_of(d.parts[1].region), pi * (1 - 1.0 / 16), 0.02);
  ASSERT_EQ(d.parts[0].lines.size(), 2U);
  EXPECT_NEAR(length_of(d.parts[0].lines[0]) + length_of(d.parts[0].lines[1]), 2 * pi * 1.25, 0.01);
}

TriangleMesh square() {
  TriangleMesh mesh;
  constexpr int n = 20;
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.push_back({double(i) / n, double(j) / n, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j, b = a + 1, c = b + n + 1, d = a + n + 1;
      for (const Triangle& t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
        mesh.triangles.push_back(t);
        for (const int v : t) {  // two charts: the right half lies in the next tile
          uv.values.push_back(mesh.points[v][0] + (i < n / 2 ? 0 : 0.5));
          uv.values.push_back(mesh.points[v][1]);
        }
      }
    }
  mesh.set(uv);
  return mesh;
}

TEST(CoatLines, OnUvTheyAreCutAtSeams) {
  const Tessellation t = tessellation(square(), [](const Point& p) { return p[1]; });
  const LineDrawing d = lines_on_uv(t, lines_of(t, {"u = 0.33"}));
  EXPECT_FALSE(d.millimetres);
  EXPECT_EQ(d.high[0], 2);
  ASSERT_EQ(d.parts[0].lines.size(), 2U);
  ASSERT_EQ(d.parts[1].lines.size(), 2U);
  for (const auto& line : d.parts[1].lines) EXPECT_NEAR(length_of(line), 0.5, 1e-6);
  EXPECT_NEAR(area_of(d.parts[1].region), 0.67, 1e-6);
  EXPECT_THROW(lines_on_uv(sphere([](const Point& p) { return p[0]; }), {}), Error);
}

TEST(CoatLines, HalfwayByDefault) {
  const Tessellation t = sphere([](const Point& p) { return 5 + p[0]; });
  for (const auto& lines : {lines_of(t, {}), lines_of(t, {"u"})}) {
    const auto in_space = lines_in_space(t, lines);
    EXPECT_NEAR(length_of(in_space[0].lines[0]), 2 * pi, 1e-2);
  }
}

TEST(CoatLines, BordersOfLayersByDefault) {
  Look look;
  look.layers.resize(3);
  look.layers[0].color = {"#ffffff", {}};
  look.layers[1].color = {"#ff0000", {}};
  look.layers[1].opacity = {"0.8*smoothstep(0.2, 0.4, u)", {}};
  look.layers[2].ramp = {"science", {}};
  look.layers[2].value = {"u", {}};
  look.layers[2].low = 0.4;
  look.layers[2].high = 0.8;
  const Tessellation t = sphere([](const Point& p) { return p[1]; });
  const auto lines = coat_lines({}, paint_of(look), t, {0});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].name, "layer2");
  EXPECT_EQ(lines[0].color[0], 1);
  const auto in_space = lines_in_space(t, lines);
  EXPECT_NEAR(length_of(in_space[0].lines[0]), 2 * pi * std::sqrt(1 - 0.09), 5e-3);
  EXPECT_NEAR(length_of(in_space[1].lines[0]), 2 * pi * 0.8, 5e-3);
}

TEST(CoatLines, WhatIsNoIsolineIsRefused) {
  for (const char* text : {"u = 1 = 2", "= 3", "w = 3", "u >", ""})
    EXPECT_THROW(parse_isoline(text, {"u"}), Error) << text;
}

}  // namespace
}  // namespace pelage
