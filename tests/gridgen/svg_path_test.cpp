#include "gridgen/svg_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "shape/vectors.h"

namespace pelage {
namespace {

SvgPath path(const std::string& data) { return parse_svg_path({data, {"a.toml", 3, 8}}); }

std::string fault_of(const std::string& data) {
  try {
    path(data);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

void expect_points(const SvgPath& p, const std::vector<double>& t, const std::vector<Point>& expected) {
  const std::vector<Point> points = p.curve.at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_LT(length(difference(points[i], expected[i])), 1e-12) << t[i] << ": " << points[i][0] << " " << points[i][1];
}

TEST(SvgPath, lines_absolute_and_relative) {
  const SvgPath a = path("M 1 2 L 4 2 V 6 H 1 Z"), b = path("m1,2 3,0v4h-3z");
  EXPECT_TRUE(a.closed);
  const std::vector<double> t = {0, 0.25, 0.5, 0.75, 0.875, 1};
  const std::vector<Point> expected = {{1, -2, 0}, {4, -2, 0}, {4, -6, 0}, {1, -6, 0}, {1, -4, 0}, {1, -2, 0}};
  expect_points(a, t, expected);
  expect_points(b, t, expected);
}

TEST(SvgPath, cubic_and_quadratic_curves_and_their_smooth_forms) {
  expect_points(path("M0 0C0 3 3 3 3 0"), {0.5}, {{1.5, -2.25, 0}});
  expect_points(path("M0 0 Q 1 2 2 0"), {0.5}, {{1, -1, 0}});
  // The mirrored control points, written out.
  const std::vector<double> t = {0.6, 0.75, 0.9};
  expect_points(path("M0 0c0 3 3 3 3 0s3-3 3 0"), t, path("M0 0C0 3 3 3 3 0C3-3 6-3 6 0").curve.at(t));
  expect_points(path("M0 0q1 2 2 0t2 0"), t, path("M0 0Q1 2 2 0Q3-2 4 0").curve.at(t));
}

TEST(SvgPath, arcs_are_those_of_ellipses) {
  const SvgPath p = path("M 2 0 A 2 1 0 0 1 -2 0");  // with y downwards the lower half
  for (const double t : {0.1, 0.5, 0.8}) {
    const Point q = p.curve.at(std::array{t})[0];
    EXPECT_NEAR(q[0] * q[0] / 4 + q[1] * q[1], 1, 1e-12);
    EXPECT_LT(q[1], 0);
  }
  expect_points(path("M1 0a1 1 0 0 0-2 0"), {0.5}, {{0, 1, 0}});
  expect_points(path("M0 0a1 1 0 116 0"), {0.5}, {{3, 3, 0}});  // grown until it reaches
  const Point turned = path("M1 1A2 1 90 0 1 -1 1").curve.at(std::array{0.5})[0];
  EXPECT_NEAR(turned[0], 0, 1e-12);
  EXPECT_NEAR(turned[1], -3, 1e-12) << "the end of the longer half axis";
}

TEST(SvgPath, faults_carry_their_place) {
  EXPECT_EQ(fault_of("L 1 2"), "a.toml:3:8: path data begin with M");
  EXPECT_EQ(fault_of("M 0 0 L 1"), "a.toml:3:17: expected a number of the path data here");
  EXPECT_EQ(fault_of("M 0 0 X 1"), "a.toml:3:14: \"X\" is no command of path data; known are M L H V C S Q T A Z");
  EXPECT_EQ(fault_of("M 0 0\nL 1 1 M 2 2"), "a.toml:4:7: the path has several subpaths; give one of them alone");
  EXPECT_EQ(fault_of("M 0 0 A 1 1 0 2 0 1 1"), "a.toml:3:22: expected a flag of an arc here: 0 or 1");
  EXPECT_EQ(fault_of("M 1 1 L 1 1"), "a.toml:3:8: the path has no extent; draw at least one line");
}

TEST(SvgPath, is_found_in_a_file) {
  const std::string file = testing::TempDir() + "pelage_svg_path_test.svg";
  std::ofstream(file) << "<svg>\n<path id=\"a\" d=\"M 0 0 L 1 0\"/>\n<path d='M 5 5 H 6' id='b' />\n"
                         "<path id=\"c\" transform=\"scale(2)\" d=\"M 0 0 H 1\"/></svg>\n";
  EXPECT_EQ(svg_file_path(file, "b").text, "M 5 5 H 6");
  EXPECT_EQ(svg_file_path(file, "a").where.line, 2);
  EXPECT_EQ(svg_file_path(file, "a").where.column, 17);
  EXPECT_THROW(svg_file_path(file, ""), Error);
  EXPECT_THROW(svg_file_path(file, "c"), Error);
  EXPECT_THROW(svg_file_path(file, "d"), Error);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace pelage
