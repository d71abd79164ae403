// Files of patches: formulas, Bezier control points, .bpt files, and their faults.

#include "gridgen/patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "pelage/error.h"
#include "shape/atlas.h"

namespace pelage {
namespace {

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Control points of the plane z = 2 x + 3 y over [a, a + 1] x [0, 1]: linear functions are reproduced.
std::array<Point, 16> plane_from(double a) {
  std::array<Point, 16> control;
  for (std::size_t k = 0; k < 16; ++k) {
    const double x = a + static_cast<double>(k % 4) / 3, y = static_cast<double>(k / 4) / 3;
    control[k] = {x, y, 2 * x + 3 * y};
  }
  return control;
}

std::string bpt_of(const std::vector<std::array<Point, 16>>& patches) {
  std::string text = std::to_string(patches.size()) + "\n";
  for (const auto& control : patches) {
    text += "3 3\n";
    for (const Point& p : control)
      text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\r\n";
  }
  return text;
}

TEST(Patches, BezierPatchesReproducePlanesAndTheirCorners) {
  const auto control = plane_from(0);
  for (const double u : {0.0, 0.3, 1.0})
    for (const double v : {0.0, 0.6, 1.0}) {
      const Point p = bezier_point(control, u, v);
      EXPECT_NEAR(p[0], u, 1e-12);
      EXPECT_NEAR(p[1], v, 1e-12);
      EXPECT_NEAR(p[2], 2 * u + 3 * v, 1e-12);
    }
}

TEST(Patches, FilesOfBezierPatchesAreReadAndSewn) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "pelage_patches_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "two.bpt") << bpt_of({plane_from(0), plane_from(1)});
  const Atlas atlas =
      parse_patches("nodes = [5, 7]\n[[patch]]\nname = \"p\"\nfile = \"two.bpt\"\n", (folder / "a.toml").string());
  ASSERT_EQ(atlas.patches.size(), 2U);
  EXPECT_EQ(atlas.patches[1].name, "p2");
  EXPECT_EQ(atlas.nodes, 2 * 5 * 7 - 7);
  EXPECT_EQ(parse_patches("nodes = [5, 7]\n[[patch]]\nfile = \"two.bpt\"\n", (folder / "a.toml").string(), 3).nodes,
            2 * 13 * 19 - 19);
  std::filesystem::remove_all(folder);
}

TEST(Patches, FormulasKnowParametersAndPi) {
  const Atlas atlas = parse_patches(
      "parameters = { r = 2 }\nnodes = [33, 5]\n[[patch]]\n[patch.formula]\nx = \"r*cos(2*pi*u)\"\n"
      "y = \"r*sin(2*pi*u)\"\nz = \"v\"\n",
      "tube.toml");
  EXPECT_EQ(atlas.nodes, 32 * 5);
  for (const Point& p : mesh_of(atlas).points) EXPECT_NEAR(std::hypot(p[0], p[1]), 2, 1e-12);
}

TEST(Patches, FaultsAreLocated) {
  const auto fault = [](const std::string& text) { return message_of([&] { parse_patches(text, "p.toml"); }); };
  const std::string formula = "[patch.formula]\nx = \"u\"\ny = \"v\"\nz = \"0\"\n";
  EXPECT_NE(fault("[[patch]]\nnodes = [2, 5]\n" + formula).find("from 3 to 10000"), std::string::npos);
  EXPECT_NE(fault("[[patch]]\nnodes = [10000, 10000]\n" + formula).find("too much memory"), std::string::npos);
  EXPECT_NE(fault("[[patch]]\nname = \"a\"\n").find("either formulas of u and v"), std::string::npos);
  EXPECT_NE(fault("[[patch]]\nbezier = [[0, 0, 0]]\n").find("16 control points"), std::string::npos);
  EXPECT_NE(fault("[[patch]]\n[patch.formula]\nx = \"1/u\"\ny = \"v\"\nz = \"0\"\n").find("not finite at u = 0"),
            std::string::npos);
  EXPECT_NE(fault("[[patch]]\n[patch.formula]\nx = \"w\"\ny = \"v\"\nz = \"0\"\n").find("w"), std::string::npos);
  EXPECT_NE(fault("smooth = true\n[[patch]]\n" + formula).find("smooth"), std::string::npos);
}

TEST(Patches, DamagedFilesAreRefusedWithTheLine) {
  const auto fault = [](const std::string& text) { return message_of([&] { parse_bpt(text, "t.bpt"); }); };
  const std::string good = bpt_of({plane_from(0)});
  EXPECT_EQ(fault(good), "");
  EXPECT_NE(fault("2" + good.substr(1)).find("expected the degree"), std::string::npos);
  EXPECT_NE(fault(good + "1 2 3").find("more follows"), std::string::npos);
  EXPECT_NE(fault("1\n2 3\n").find("not one that the file can hold"), std::string::npos);
  EXPECT_NE(fault("999999999\n3 3\n").find("not one that the file can hold"), std::string::npos);
  EXPECT_NE(fault(good.substr(0, good.size() - 20)).find("expected a coordinate"), std::string::npos);
  std::string other = good;
  other.replace(2, 3, "2 3");
  EXPECT_NE(fault(other).find("only bicubic patches"), std::string::npos);
}

}  // namespace
}  // namespace pelage
