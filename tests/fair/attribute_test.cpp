#include "fair/attribute.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fair/noisy.h"
#include "pelage/error.h"

namespace pelage {
namespace {

using Function = double (*)(const Point&);

double step_of_z(const Point& p) { return p[2] > 0 ? 1 : 0; }
double height(const Point& p) { return p[2]; }

TriangleMesh with_function(const std::string& shape, Function f, double noise, const std::string& name = "f") {
  TriangleMesh mesh = builtin_shape(shape);
  Attribute a{name, 1, Domain::vertex, {}};
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    a.values.push_back(f(mesh.points[v]) + noise * testing::gaussian(7, v));
  mesh.set(std::move(a));
  return mesh;
}

double error_of(const TriangleMesh& mesh, Function f) {
  double sum = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    sum += std::pow(mesh.find("f")->values[v] - f(mesh.points[v]), 2);
  return std::sqrt(sum / static_cast<double>(mesh.points.size()));
}

TEST(Attribute, EdgesOfAFunctionStay) {
  const TriangleMesh noisy = with_function("builtin:torus?n=4000", step_of_z, 0.1);
  const SmoothedAttribute edged = smooth_attribute(noisy, "f");
  const SmoothedAttribute blurred = smooth_attribute(noisy, "f", {.method = "isotropic"});
  EXPECT_NEAR(edged.report.noise, 0.1, 0.02);
  EXPECT_LT(error_of(edged.mesh, step_of_z), 0.03);
  EXPECT_GT(error_of(blurred.mesh, step_of_z), 2 * error_of(edged.mesh, step_of_z));
  EXPECT_EQ(edged.mesh.points, noisy.points);
}

TEST(Attribute, NoiseComesOffASmoothFunction) {
  const TriangleMesh noisy = with_function("builtin:torus?n=4000", height, 0.05);
  for (const std::string& method : attribute_methods()) {
    const SmoothedAttribute result = smooth_attribute(noisy, "f", {.method = method});
    EXPECT_LT(error_of(result.mesh, height), 0.02) << method;
    EXPECT_NEAR(result.report.changed, 0.05, 0.01) << method;
  }
}

/// On the unit sphere z is an eigenfunction of the Laplacian, with eigenvalue -2: a step divides it by 1 + 2 tau. There
/// curvature throttles nothing.
TEST(Attribute, StepsOnASphereAreHeatFlow) {
  const TriangleMesh mesh = with_function("builtin:sphere?n=10242", height, 0);
  const double h = testing::mean_edge(mesh), tau = 50;
  const double factor = std::pow(1 + 2 * tau * h * h, -2);
  EXPECT_LT(factor, 0.9);
  const auto smoothed = [&](const std::string& method) {
    return smooth_attribute(mesh, "f", {.method = method, .noise = 1, .steps = 2, .tau = tau}).mesh;
  };
  const TriangleMesh isotropic = smoothed("isotropic"), paper = smoothed("paper");
  double product = 0, square = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    ASSERT_NEAR(isotropic.find("f")->values[v], factor * mesh.points[v][2], 1e-3);
    product += paper.find("f")->values[v] * mesh.points[v][2];
    square += mesh.points[v][2] * mesh.points[v][2];
  }
  EXPECT_NEAR(product / square, factor, 0.01);  // its density differs a little from place to place
}

/// Root mean square error beside the edges of a cube's upper face, whose vertices belong to both sides.
double error_beside_top_edges(const TriangleMesh& mesh, Function f) {
  const double a = std::abs(mesh.points[0][0]);
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point& p = mesh.points[v];
    const double below = a - p[2], beside = a - std::max(std::abs(p[0]), std::abs(p[1]));
    if (below + beside > 0.2 * a || std::max(below, beside) < 1e-9) continue;
    sum += std::pow(mesh.find("f")->values[v] - f(p), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(Attribute, CurvatureKeepsApartWhatEdgesOfTheShapePart) {
  const Function top = [](const Point& p) {
    return p[2] > 0.999 * std::max(std::abs(p[0]), std::abs(p[1])) ? 1.0 : 0.0;
  };
  const auto smoothed = [](Function f, const std::string& method) {
    const TriangleMesh noisy = with_function("builtin:cube?n=3000", f, 0.1);
    return smooth_attribute(noisy, "f", {.method = method, .steps = 8, .tau = 0.2}).mesh;
  };
  EXPECT_LT(error_beside_top_edges(smoothed(top, "paper"), top),
            0.5 * error_beside_top_edges(smoothed(top, "isotropic"), top));
  // Edges of the function within a side are none of the shape.
  EXPECT_NEAR(error_of(smoothed(step_of_z, "paper"), step_of_z) / error_of(smoothed(step_of_z, "isotropic"), step_of_z),
              1, 0.2);
}

TEST(Attribute, ColoursAreSmoothedTogetherAndKeepTheirRange) {
  TriangleMesh mesh = builtin_shape("builtin:animal?n=2000");
  Attribute color{"color", 3, Domain::vertex, {}};
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::uint64_t c = 0; c < 3; ++c) {
      const double clean = mesh.points[v][0] > 0 ? (c == 0 ? 0.8 : 0.3) : (c == 2 ? 0.7 : 0.2);
      color.values.push_back(std::clamp(clean + 0.1 * testing::gaussian(c, v), 0.0, 1.0));
    }
  mesh.set(color);
  const SmoothedAttribute result = smooth_attribute(mesh, "color");
  EXPECT_GT(result.report.steps, 1);
  for (double x : result.mesh.find("color")->values) {
    EXPECT_GE(x, 0);
    EXPECT_LE(x, 1);
  }
}

TEST(Attribute, WithoutNoiseNothingChanges) {
  const TriangleMesh mesh = with_function(
      "builtin:sphere?n=642", [](const Point&) { return 3.0; }, 0);
  const SmoothedAttribute result = smooth_attribute(mesh, "f");
  EXPECT_LT(result.report.noise, 1e-12);
  EXPECT_LT(error_of(result.mesh, [](const Point&) { return 3.0; }), 1e-12);
}

TEST(Attribute, WhatCannotBeSmoothedIsRefused) {
  TriangleMesh mesh = with_function("builtin:sphere?n=162", height, 0.1);
  EXPECT_THROW(smooth_attribute(mesh, "g"), Error);
  EXPECT_THROW(smooth_attribute(mesh, "f", {.method = "guided"}), Error);
  EXPECT_THROW(smooth_attribute(mesh, "f", {.noise = -1}), Error);
  EXPECT_THROW(smooth_attribute(mesh, "f", {.steps = -1}), Error);
  EXPECT_THROW(smooth_attribute(mesh, "f", {.tau = 0}), Error);
  mesh.set({"uv", 2, Domain::corner, std::vector<double>(6 * mesh.triangles.size(), 0.5)});
  EXPECT_THROW(smooth_attribute(mesh, "uv"), Error);
  EXPECT_THROW(smooth_attribute(builtin_shape("builtin:sphere?n=162"), "normal"), Error);
}

}  // namespace
}  // namespace pelage
