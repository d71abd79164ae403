#include "shape/texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shape/refine.h"
#include "shape/sample_meshes.h"

namespace pelage {
namespace {

/// A grey image; the rows from the top, values of 0..1.
Texture grey(int width, const std::vector<double>& values) {
  std::vector<std::uint16_t> rgb;
  for (const double v : values) rgb.insert(rgb.end(), 3, static_cast<std::uint16_t>(std::lround(65535 * v)));
  return {"age", width, static_cast<int>(values.size()) / width,
          std::make_shared<const std::vector<std::uint16_t>>(std::move(rgb))};
}

constexpr double step = 1.0 / 65535;  // of stored values

TEST(Texture, IsLinearBetweenTheCentresOfPixelsAndRepeats) {
  const Texture t = grey(2, {0.8, 0.4,    // top
                             0.2, 0.6});  // bottom
  const auto at = [&](double u, double v) { return color_at(t, u, v)[1]; };
  EXPECT_NEAR(at(0.25, 0.75), 0.8, step);
  EXPECT_NEAR(at(0.75, 0.75), 0.4, step);
  EXPECT_NEAR(at(0.25, 0.25), 0.2, step);  // v goes up
  EXPECT_NEAR(at(0.75, 0.25), 0.6, step);
  EXPECT_NEAR(at(0.5, 0.5), 0.5, step);
  EXPECT_NEAR(at(0.35, 0.25), 0.2 * 0.8 + 0.6 * 0.2, step);
  EXPECT_NEAR(at(0.25, 0.65), 0.8 * 0.8 + 0.2 * 0.2, step);
  EXPECT_NEAR(at(0, 0.75), 0.6, step);  // half of the first pixel, half of the last
  EXPECT_NEAR(at(0.25, 1), 0.5, step);
  EXPECT_NEAR(at(0.95, 0.75), 0.4 * 0.6 + 0.8 * 0.4, step);  // beyond the last centre
  EXPECT_NEAR(at(0.25, 0.05), 0.2 * 0.6 + 0.8 * 0.4, step);
  for (const auto& [u, v] : {std::pair{0.1, 0.3}, {0.9, 0.05}})
    for (const int k : {-3, 1, 7}) {
      EXPECT_NEAR(at(u + k, v), at(u, v), 1e-12);
      EXPECT_NEAR(at(u, v + k), at(u, v), 1e-12);
    }
}

TEST(Texture, OddPlacesStayInsideOfTheImage) {
  const Texture t = grey(3, {0.5, 0.5, 0.5});
  for (const double u : {-1e-20, 1.0, -1.0, 1e300, -1e300, std::nan(""), HUGE_VAL})
    for (const double v : {-1e-20, 0.5, std::nan("")}) EXPECT_NEAR(color_at(t, u, v)[0], 0.5, step);
}

TEST(Texture, GivesLuminanceAndChannels) {
  EXPECT_EQ(color_names("c")[3], "c_3");
  const Texture red{"c", 1, 1,
                    std::make_shared<const std::vector<std::uint16_t>>(std::vector<std::uint16_t>{65535, 0, 13107})};
  const Attribute uv{"uv", 2, Domain::vertex, {0, 0, 0, 0, 0, 0, 0, 0}};
  const VertexAttributes values = texture_attributes(red, {{0, 1, 2}}, 4, uv);
  EXPECT_NEAR(values.at("c")[0], 0.2126 + 0.0722 * 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(values.at("c_1")[1], 1);
  EXPECT_DOUBLE_EQ(values.at("c_2")[2], 0);
  EXPECT_DOUBLE_EQ(values.at("c_3")[2], 0.2);
  EXPECT_EQ(values.at("c_1")[3], 0);  // of no triangle
}

TEST(Texture, AtASeamTheMeanOfTheCornersCounts) {
  const Texture t = grey(4, {0.1, 0.3, 0.5, 0.9});
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto pixel = [](int i) { return (i + 0.5) / 4; };
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (const int i : {0, 1, 2, 0, 3, 1}) uv.values.insert(uv.values.end(), {pixel(i), 0.5});
  const std::vector<double> age = texture_attributes(t, triangles, 4, uv).at("age");
  EXPECT_NEAR(age[0], 0.1, step);
  EXPECT_NEAR(age[1], 0.3, step);
  EXPECT_NEAR(age[2], (0.5 + 0.9) / 2, step);
  EXPECT_NEAR(age[3], 0.3, step);
  const Attribute at_vertices{"uv", 2, Domain::vertex, {pixel(3), 0.5, pixel(2), 0.5, pixel(1), 0.5, pixel(0), 0.5}};
  const std::vector<double> whole = texture_attributes(t, triangles, 4, at_vertices).at("age");
  for (const auto& [vertex, value] : {std::pair{0, 0.9}, {1, 0.5}, {2, 0.3}, {3, 0.1}})
    EXPECT_NEAR(whole[static_cast<std::size_t>(vertex)], value, step);
}

/// Splitting keeps uv linear in every triangle, at vertices and at corners alike.
TEST(Texture, UvIsLinearOverTheTrianglesOfASplitMesh) {
  TriangleMesh mesh = test::torus();
  Attribute corner{"corner", 2, Domain::corner, {}}, vertex{"vertex", 2, Domain::vertex, {}};
  for (const Point& p : mesh.points) vertex.values.insert(vertex.values.end(), {p[0] + p[2], 2 * p[1]});
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t v : t)
      corner.values.insert(corner.values.end(), {mesh.points[v][0] + mesh.points[v][2], 2 * mesh.points[v][1]});
  mesh.attributes = {corner, vertex};
  const TriangleMesh fine = split_at_midpoints(split_at_midpoints(mesh));
  ASSERT_EQ(fine.triangles.size(), 16 * mesh.triangles.size());
  for (std::size_t c = 0; c < 3 * fine.triangles.size(); ++c) {
    const auto v = static_cast<std::size_t>(fine.triangles[c / 3][c % 3]);
    const double u = fine.points[v][0] + fine.points[v][2];
    ASSERT_NEAR(fine.find("corner")->values[2 * c], u, 1e-12);
    ASSERT_NEAR(fine.find("vertex")->values[2 * v], u, 1e-12);
    ASSERT_NEAR(fine.find("corner")->values[2 * c + 1], 2 * fine.points[v][1], 1e-12);
  }
}

}  // namespace
}  // namespace pelage
