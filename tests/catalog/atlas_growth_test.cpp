// Patches that are sewn together, and grids that are stretched: no seam and no distortion in what grows on them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/dense.h"
#include "catalog/bind.h"
#include "catalog/shapes.h"
#include "discretise/grid_space.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/grow.h"
#include "run/run.h"
#include "shape/atlas.h"

namespace pelage {
namespace {

using CoatRun = Run;  // in a test, Run is a function of its own

// --- a sphere of six patches -------------------------------------------------------------------------------

/// Ritz values of the lowest 25 modes, from the coordinates' products up to degree 4 by inverse iteration.
Vector lowest_eigenvalues(const Space& space) {
  constexpr Eigen::Index modes = 25;
  const SparseMatrix mass = *space.sampled(SampleRule::vertices).mass, stiffness = *space.stiffness();
  SparseMatrix shifted;
  combine(1, stiffness, 1, mass, shifted);
  Eigen::MatrixXd basis(space.unknowns(), modes);
  for (Eigen::Index v = 0; v < basis.rows(); ++v) {
    const auto& [x, y, z] = space.control()[static_cast<std::size_t>(v)];
    Eigen::Index k = 0;
    // On the sphere z^2 = 1 - x^2 - y^2: no power of z beyond the first is of its own.
    for (int c = 0; c < 2; ++c)
      for (int a = 0; a <= 4; ++a)
        for (int b = 0; a + b + c <= 4; ++b) basis(v, k++) = std::pow(x, a) * std::pow(y, b) * std::pow(z, c);
  }
  Vector values;
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::MatrixXd m(basis.rows(), modes), k(basis.rows(), modes);
    for (Eigen::Index j = 0; j < modes; ++j) {
      basis.col(j) = solve_spd(shifted, mass * Vector(basis.col(j)), {.tolerance = 1e-12});
      m.col(j) = mass * Vector(basis.col(j));
      k.col(j) = stiffness * Vector(basis.col(j));
    }
    const Modes ritz = symmetric_modes(basis.transpose() * k, basis.transpose() * m);
    values = ritz.values;
    basis *= ritz.vectors;
  }
  return values;
}

std::array<double, 4> errors_by_degree(const Space& space) {
  const Vector values = lowest_eigenvalues(space);
  std::array<double, 4> errors{};
  Eigen::Index k = 1;
  for (int l = 1; l <= 4; ++l)
    for (int m = 0; m < 2 * l + 1; ++m)
      errors[static_cast<std::size_t>(l - 1)] =
          std::max(errors[static_cast<std::size_t>(l - 1)], std::abs(values[k++] / (l * (l + 1)) - 1));
  return errors;
}

/// l (l + 1), to the second order of the cells.
TEST(AtlasGrowth, TheCubedSphereHasTheEigenvaluesOfTheSphere) {
  // A third as many cells as in the file, and two thirds.
  const auto space = [](std::int32_t nodes) {
    const ShapeFile file = find_shape("builtin:cube-sphere");
    std::vector<Atlas::Patch> coarse = as<Atlas>(file.nodes)->patches;
    const std::int32_t n = coarse[0].grid.count[0], every = (n - 1) / (nodes - 1);
    for (Atlas::Patch& p : coarse) {
      Grid grid;
      grid.count = {nodes, nodes, 1};
      for (std::int32_t j = 0; j < nodes; ++j)
        for (std::int32_t i = 0; i < nodes; ++i)
          grid.points.push_back(p.grid.point(p.grid.node(every * i, every * j, 0)));
      p = {p.name, grid, {}};
    }
    return GridSpace(sew(std::move(coarse)));
  };
  const auto coarse = errors_by_degree(space(11)), fine = errors_by_degree(space(21));
  for (std::size_t l = 0; l < 4; ++l) {
    EXPECT_GE(std::log2(coarse[l] / fine[l]), 1.9) << l + 1;
    EXPECT_LT(fine[l], 6e-3) << l + 1;
  }
}

Recipe spots(double size, std::uint64_t seed) {
  Recipe recipe = parse_recipe("[stage]\nmodel = \"schnakenberg\"\n", "test");
  recipe.stages[0].size = {{size, Length::Unit::world}, {}};
  recipe.stages[0].seed = seed;
  return recipe;
}

CoatRun grown(Program program) {
  CoatRun run(std::move(program));
  run.advance(1'000'000);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  return run;
}

double wavelength_of(const CoatRun& run) {
  return measured_wavelength(*run.space().sampled(SampleRule::vertices).mass, *run.space().stiffness(),
                             run.coefficients()[1]);
}

/// Mean and scatter of a field over the nodes that a condition takes, by their areas.
struct Statistics {
  double mean = 0, variance = 0;
};
template <class Takes>
Statistics statistics(const Vector& u, const Vector& weight, Takes&& takes) {
  double area = 0;
  Statistics s;
  for (Eigen::Index v = 0; v < u.size(); ++v)
    if (takes(v)) {
      area += weight[v];
      s.mean += weight[v] * u[v];
      s.variance += weight[v] * u[v] * u[v];
    }
  s.mean /= area;
  s.variance = s.variance / area - s.mean * s.mean;
  return s;
}

/// By how many standard errors a list of differences is from 0.
double sigmas(const std::vector<double>& differences) {
  const auto n = static_cast<double>(differences.size());
  double mean = 0, square = 0;
  for (const double d : differences) mean += d / n;
  for (const double d : differences) square += (d - mean) * (d - mean) / (n - 1);
  return std::abs(mean) / std::sqrt(square / n);
}

/// The spacing is that on a sphere without patches, and near seams and corners the pattern is like anywhere.
TEST(AtlasGrowth, NothingOfTheSeamsShowsInThePattern) {
  const ShapeFile file = find_shape("builtin:cube-sphere");
  constexpr double size = 0.45, near = 0.12;
  const auto distance_to_seam = [](const Point& p) {  // on the sphere, about
    std::array<double, 3> x = {std::abs(p[0]), std::abs(p[1]), std::abs(p[2])};
    std::ranges::sort(x);
    return (x[2] - x[1]) / std::numbers::sqrt2;
  };
  std::vector<double> means, variances;
  double patched = 0, plain = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const CoatRun run = grown(bind_plan(plan(spots(size, seed)), file.nodes, file.mesh));
    const Vector& u = run.coefficients()[1];
    const Vector& weight = run.system().sampling->weight;
    const auto at_seam = [&](Eigen::Index v) {
      return distance_to_seam(run.space().control()[static_cast<std::size_t>(v)]) < near;
    };
    const Statistics seam = statistics(u, weight, at_seam),
                     inside = statistics(u, weight, [&](Eigen::Index v) { return !at_seam(v); });
    means.push_back(seam.mean - inside.mean);
    variances.push_back(seam.variance - inside.variance);
    if (seed > 2) continue;
    patched += wavelength_of(run);
    Recipe on_loop = spots(size, seed);
    on_loop.stages[0].method = {"loop", {}};
    plain += wavelength_of(grown(make_program(on_loop, load_shape("builtin:sphere?n=2562"))));
  }
  EXPECT_LT(sigmas(means), 3);
  EXPECT_LT(sigmas(variances), 3);
  EXPECT_NEAR(patched / plain, 1, 0.03);
}

TEST(AtlasGrowth, AMoebiusBandGrowsACoatToo) {
  const ShapeFile file = find_shape("builtin:moebius");
  EXPECT_TRUE(as<Atlas>(file.nodes)->one_sided);
  const CoatRun run = grown(bind_plan(plan(spots(0.35, 1)), file.nodes, file.mesh));
  EXPECT_FALSE(run.uniform());
  EXPECT_NEAR(wavelength_of(run) / 0.35, 1, 0.15);
}

// --- a parametrisation whose metric is ten times as large on one side as on the other
// --------------------------------------------

struct Stretched {
  Grid even, curved;
};

Stretched stretched_sheet() {
  constexpr std::int32_t nx = 193, ny = 65;
  constexpr double h = 1.0 / 64;
  const double ratio = std::sqrt(10.0);
  Stretched s;
  s.even.count = s.curved.count = {nx, ny, 1};
  s.even.spacing = {h, h, 1};
  std::vector<double> x{0};
  for (std::int32_t i = 1; i < nx; ++i) {
    const double t = (i - 0.5) / (nx - 1);
    // Dense on the left, coarse on the right, between them smooth.
    const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp((t - 0.52) / 0.2, 0.0, 1.0));
    x.push_back(x.back() + h * std::pow(ratio, share - 1));
  }
  for (std::int32_t j = 0; j < ny; ++j)
    for (std::int32_t i = 0; i < nx; ++i) s.curved.points.push_back({x[static_cast<std::size_t>(i)], h * j, 0});
  return s;
}

/// Across the sheet's first axis: 2 pi sqrt(<(u - mean)^2> / <|grad u|^2>) over part of the nodes.
template <class Takes>
double local_wavelength(const GridSpace& space, const Vector& u, Takes&& takes) {
  const Vector weight = space.sampled(SampleRule::vertices).sampling->weight,
               gradient = space.gradient_product(SampleRule::vertices, u, u);
  return 2 * std::numbers::pi *
         std::sqrt(statistics(u, weight, takes).variance / statistics(gradient, weight, takes).mean);
}

TEST(AtlasGrowth, AStretchedParametrisationLeavesThePatternAlone) {
  const Stretched s = stretched_sheet();
  const GridSpace surface(s.curved);
  constexpr double size = 0.16;
  const auto left = [&](Eigen::Index v) { return v % 193 > 4 && v % 193 < 98; };
  const auto right = [&](Eigen::Index v) { return v % 193 > 142 && v % 193 < 188; };
  std::array<double, 2> corrected{}, plain{}, uncorrected{};
  constexpr int seeds = 3;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const CoatRun on_surface = grown(make_program(spots(size, seed), s.curved)),
                  in_parameters = grown(make_program(spots(size, seed), s.even));
    const GridSpace flat(s.even);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto add = [&](const auto& takes) {
        corrected[k] += local_wavelength(surface, on_surface.coefficients()[1], takes) / seeds;
        uncorrected[k] += local_wavelength(surface, in_parameters.coefficients()[1], takes) / seeds;
        plain[k] += local_wavelength(flat, in_parameters.coefficients()[1], takes) / seeds;
      };
      if (k == 0)
        add(left);
      else
        add(right);
    }
  }
  // Spots have harmonics, so that the figure is a little below the size: the even sheet says how much.
  const double wanted = (plain[0] + plain[1]) / 2;
  EXPECT_NEAR(wanted / size, 1, 0.15);
  for (const double wavelength : corrected) EXPECT_NEAR(wavelength / wanted, 1, 0.07);
  EXPECT_LT(uncorrected[0], wanted / 2);
}

}  // namespace
}  // namespace pelage
