// Diffusion on even grids without matrices, against the elements and the theory of waves.

#include "discretise/lattice_stencil.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "discretise/grid_space.h"

namespace pelage {
namespace {

Lattice lattice(std::array<std::size_t, 3> count, std::array<bool, 3> periodic) {
  return {count, periodic, {0.1, 0.13, 0.07}};
}

Eigen::Matrix3d straight() { return Eigen::Vector3d(1, 0.4, 2).asDiagonal(); }
Eigen::Matrix3d full() {
  Eigen::Matrix3d t;
  t << 1, 0.3, 0.1, 0.3, 0.5, -0.2, 0.1, -0.2, 0.8;
  return t;
}

/// Of the wave whose phase changes so much from node to node.
double rate(const LatticeStencil& stencil, const Eigen::Vector3d& phase) {
  double sum = 0;
  for (const auto& [step, weight] : stencil.neighbours)
    sum += 2 * weight * (1 - std::cos(step[0] * phase[0] + step[1] * phase[1] + step[2] * phase[2]));
  return sum;
}

/// Along a line it is the elements' mass inverted by one term of its series.
TEST(Stencils, AreTheElementsAlongALine) {
  for (const bool periodic : {true, false}) {
    Grid grid;
    grid.count = {17, 1, 1};
    grid.periodic = {periodic, false, false};
    grid.spacing = {0.1, 1, 1};
    const GridSpace space(grid);
    const SampledMass sampled = space.sampled(SampleRule::vertices);
    const SharedMatrix k = space.stiffness();
    const Vector u = Vector::Random(17), &lumped = sampled.sampling->weight;
    const Vector product = -(*k * u).cwiseQuotient(lumped);
    const Vector expected = 2 * product - (*sampled.mass * product).cwiseQuotient(lumped);
    const auto at = [&](int i) { return periodic ? (i + 17) % 17 : i < 0 ? -i : i > 16 ? 32 - i : i; };
    for (int i = 0; i < 17; ++i) {
      double sum = 0;
      for (const auto& [step, weight] : lattice_stencil(*space.lattice(), Eigen::Matrix3d::Identity()).neighbours)
        sum += weight * (u[at(i + step[0])] + u[at(i - step[0])] - 2 * u[i]);
      EXPECT_NEAR(sum, expected[i], 1e-11 * expected.cwiseAbs().maxCoeff());
    }
  }
}

TEST(Stencils, WavesKeepTheirRateToTheFourthOrder) {
  const Eigen::Vector3d wave(1.1, -0.7, 1.6);
  const double exact = wave.dot(full() * wave);
  const auto error = [&](double h) {
    Lattice of = lattice({9, 9, 9}, {true, true, true});
    for (double& spacing : of.spacing) spacing *= h;
    const Eigen::Vector3d phase = wave.cwiseProduct(Eigen::Vector3d::Map(of.spacing.data()));
    return std::abs(rate(lattice_stencil(of, full()), phase) / exact - 1);
  };
  EXPECT_LT(error(2), 1e-3);
  EXPECT_NEAR(std::log2(error(2) / error(1)), 4, 0.1);
}

/// However a tensor lies: all directions of those that spread along one alone, which are the hardest.
TEST(Stencils, LetNoWaveGrow) {
  using std::numbers::pi;
  Lattice of = lattice({9, 9, 9}, {true, true, true});
  of.spacing = {1, 1, 1};
  constexpr int waves = 12;
  for (int a = 0; a < 12; ++a)
    for (int b = 0; b < 12; ++b) {
      const double turn = pi * a / 12, rise = pi * b / 12;
      const Eigen::Vector3d d(std::cos(turn) * std::sin(rise), std::sin(turn) * std::sin(rise), std::cos(rise));
      const LatticeStencil stencil = lattice_stencil(of, d * d.transpose());
      for (int i = 0; i <= waves; ++i)
        for (int j = -waves; j <= waves; ++j)
          for (int k = -waves; k <= waves; ++k)
            ASSERT_GE(rate(stencil, pi / waves * Eigen::Vector3d(i, j, k)), -1e-12) << d.transpose();
    }
}

TEST(Stencils, KnowTheirLargestRate) {
  const LatticeStencil stencil = lattice_stencil(lattice({8, 6, 5}, {true, true, true}), full());
  double largest = 0;
  for (int n = 0; n < 20000; ++n)
    largest = std::max(largest, rate(stencil, std::numbers::pi * Eigen::Vector3d::Random()));
  EXPECT_GE(largest_rate(stencil), 0.999 * largest);
  EXPECT_LE(largest_rate(stencil), 1.05 * largest);
}

TEST(Stencils, HaveNoWeightsAcrossAxesThatAreNotTilted) {
  for (const auto& [step, weight] : lattice_stencil(lattice({8, 6, 5}, {false, false, false}), straight()).neighbours)
    if ((step[0] != 0) + (step[1] != 0) + (step[2] != 0) > 1) {
      EXPECT_EQ(weight, 0);
    }
}

TEST(Stencils, TiltedTensorsAreNoMatterForMirrors) {
  const Lattice periodic{{8, 8, 1}, {true, true, false}, {1, 1, 1}}, closed{{8, 8, 1}, {true, false, false}, {1, 1, 1}};
  EXPECT_FALSE(tilted_to_a_border(periodic, full()));
  EXPECT_TRUE(tilted_to_a_border(closed, full()));
  EXPECT_FALSE(tilted_to_a_border(closed, straight()));
}

}  // namespace
}  // namespace pelage
