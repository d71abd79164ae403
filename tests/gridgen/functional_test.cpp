#include "gridgen/functional.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shape/vectors.h"

namespace pelage {
namespace {

/// An uneven grid without folds over the unit square, or over a ring.
std::vector<Point> uneven(const Sheet& sheet) {
  std::vector<Point> nodes;
  for (std::int32_t j = 0; j < sheet.count[1]; ++j)
    for (std::int32_t i = 0; i < sheet.count[0]; ++i) {
      const double u = static_cast<double>(i) / (sheet.count[0] - 1), v = static_cast<double>(j) / (sheet.count[1] - 1);
      const double angle = -2 * M_PI * i / sheet.count[0], radius = 1 + v + 0.05 * std::sin(2 * angle + v);
      nodes.push_back(sheet.ring ? Point{radius * std::cos(angle), radius * std::sin(angle), 0}
                                 : Point{u + 0.04 * std::sin(7 * v + u), 0.7 * v + 0.05 * std::sin(5 * u + 3 * v), 0});
    }
  return nodes;
}

/// The largest difference between the gradient and central differences, over the largest slope.
double gradient_error(const SheetFunctional& functional, std::vector<Point> nodes) {
  constexpr double step = 1e-6;
  std::vector<Point> gradient, unused;
  functional(nodes, gradient);
  double error = 0, largest = 0;
  for (std::size_t v = 0; v < nodes.size(); ++v)
    for (std::size_t k = 0; k < 2; ++k) {
      const double here = nodes[v][k];
      nodes[v][k] = here + step;
      const double above = functional(nodes, unused);
      nodes[v][k] = here - step;
      const double below = functional(nodes, unused);
      nodes[v][k] = here;
      error = std::max(error, std::abs((above - below) / (2 * step) - gradient[v][k]));
      largest = std::max(largest, std::abs(gradient[v][k]));
    }
  return error / largest;
}

constexpr GridWeights each_alone[] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0.4, 0.3, 0.2, 0.1}};

TEST(Functional, gradient_is_that_of_differences) {
  for (const bool ring : {false, true})
    for (const GridWeights& weights : each_alone) {
      const Sheet sheet{{7, 5}, ring};
      const std::vector<Point> nodes = uneven(sheet);
      ASSERT_EQ(first_folded(sheet, nodes), sheet.cells());
      EXPECT_LT(gradient_error(SheetFunctional(sheet, nodes, weights, nullptr, nullptr), nodes), 1e-7) << ring;
    }
}

TEST(Functional, gradient_with_attraction_is_that_of_differences) {
  const NodeDensity attract(FormulaFunction({"1 + 3 * exp(-4 * x^2 - y)", {}}, {"x", "y", "z"}));
  const Sheet sheet{{6, 6}, false};
  const std::vector<Point> nodes = uneven(sheet);
  for (const GridWeights& weights : each_alone)
    EXPECT_LT(gradient_error(SheetFunctional(sheet, nodes, weights, &attract, nullptr), nodes), 1e-7);
}

TEST(Functional, gradient_on_a_surface_is_that_of_differences) {
  const auto coordinate = [](const char* text) { return FormulaFunction({text, {}}, {"u", "v"}); };
  const auto map = formula_surface({coordinate("u + 0.2 * v^2"), coordinate("v"), coordinate("0.5 * sin(2 * u) * v")});
  const NodeDensity attract(FormulaFunction({"1 + z^2 + x", {}}, {"x", "y", "z"}));
  const Sheet sheet{{6, 5}, false};
  const std::vector<Point> nodes = uneven(sheet);
  for (const GridWeights& weights : each_alone)
    EXPECT_LT(gradient_error(SheetFunctional(sheet, nodes, weights, &attract, map.get()), nodes), 1e-7);
}

/// g11 g22 = g + g12^2 in every corner: what area and orthogonality are together. On parallelograms a cell's area is
/// that of its corners.
TEST(Functional, area_and_orthogonality_are_the_product_of_squared_lengths) {
  const Sheet sheet{{5, 4}, false};
  std::vector<Point> nodes;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i) nodes.push_back({0.3 * i + 0.1 * j, 0.05 * i + 0.2 * j, 0});
  const auto parts = SheetFunctional(sheet, nodes, {}, nullptr, nullptr).parts(nodes);
  const Point e{0.3, 0.05, 0}, f{0.1, 0.2, 0};
  const double area = plane_cross(e, f);
  EXPECT_NEAR(parts.area + parts.orthogonality, dot(e, e) * dot(f, f) / (2 * area * area), 1e-12);
  EXPECT_NEAR(parts.area, 0.5, 1e-12);
  EXPECT_NEAR(parts.orthogonality, dot(e, f) * dot(e, f) / (2 * area * area), 1e-12);
}

TEST(Functional, neither_the_unit_nor_the_number_of_nodes_matters) {
  const auto value = [](std::int32_t n, double unit) {
    const Sheet sheet{{2 * n, n}, false};
    std::vector<Point> nodes = uneven(sheet), gradient;
    for (Point& p : nodes)
      for (double& x : p) x *= unit;
    return SheetFunctional(sheet, nodes, {0.1, 0.2, 0.3, 0.4}, nullptr, nullptr)(nodes, gradient);
  };
  EXPECT_NEAR(value(20, 1), value(20, 1000), 1e-12 * value(20, 1));
  EXPECT_NEAR(value(40, 1), value(80, 1), 0.02 * value(40, 1));
}

TEST(Functional, is_infinite_where_a_corner_folds) {
  const Sheet sheet{{4, 4}, false};
  std::vector<Point> nodes = uneven(sheet), gradient;
  const SheetFunctional functional(sheet, nodes, {}, nullptr, nullptr);
  EXPECT_TRUE(std::isfinite(functional(nodes, gradient)));
  nodes[5][0] += 0.5;
  EXPECT_FALSE(std::isfinite(functional(nodes, gradient)));
}

}  // namespace
}  // namespace pelage
