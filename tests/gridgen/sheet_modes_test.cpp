#include "gridgen/sheet_modes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelage {
namespace {

/// Amplitudes without any pattern.
std::vector<double> some(std::size_t count) {
  std::vector<double> a;
  for (std::size_t i = 0; i < count; ++i) a.push_back(std::sin(1.7 * static_cast<double>(i * i) + 0.3));
  return a;
}

/// 1/2 sum |e|^2 / l^2 over all edges, by the five-point differences.
double energy(const Sheet& sheet, const std::vector<Point>& x, double along, double across) {
  double sum = 0;
  const auto add = [&](std::size_t a, std::size_t b, double l) {
    for (std::size_t k = 0; k < 2; ++k) sum += (x[a][k] - x[b][k]) * (x[a][k] - x[b][k]) / (2 * l * l);
  };
  for (std::int32_t j = 0; j < sheet.count[1]; ++j)
    for (std::int32_t i = 0; i < sheet.count[0]; ++i) {
      if (i < sheet.columns()) add(sheet.node(i, j), sheet.node((i + 1) % sheet.count[0], j), along);
      if (j + 1 < sheet.count[1]) add(sheet.node(i, j), sheet.node(i, j + 1), across);
    }
  return sum;
}

TEST(SheetModes, squared_lengths_become_the_identity) {
  for (const bool ring : {false, true})
    for (const std::int32_t n : {6, 7}) {
      const Sheet sheet{{n, 5}, ring};
      const SheetModes modes(sheet, 0.7, 1.3);
      const std::vector<double> a = some(modes.size());
      std::vector<Point> moved(sheet.nodes());
      modes.displace(a, moved);
      double half_square = 0;
      for (const double x : a) half_square += x * x / 2;
      EXPECT_NEAR(energy(sheet, moved, 0.7, 1.3), half_square, 1e-12 * half_square);
    }
}

TEST(SheetModes, gradient_is_the_transpose_and_borders_stay) {
  const Sheet sheet{{9, 6}, false};
  const SheetModes modes(sheet, 1, 2);
  const std::vector<double> a = some(modes.size());
  std::vector<Point> moved(sheet.nodes()), slope(sheet.nodes());
  modes.displace(a, moved);
  double by_nodes = 0, by_amplitudes = 0;
  for (std::size_t v = 0; v < slope.size(); ++v) {
    EXPECT_TRUE(!sheet.on_border(v) || moved[v] == Point{});
    slope[v] = {std::cos(3.0 * static_cast<double>(v)), std::sin(5.0 * static_cast<double>(v)), 0};
    by_nodes += slope[v][0] * moved[v][0] + slope[v][1] * moved[v][1];
  }
  std::vector<double> gradient(modes.size());
  modes.gradient(slope, gradient);
  for (std::size_t i = 0; i < a.size(); ++i) by_amplitudes += a[i] * gradient[i];
  EXPECT_NEAR(by_nodes, by_amplitudes, 1e-12);
}

}  // namespace
}  // namespace pelage
