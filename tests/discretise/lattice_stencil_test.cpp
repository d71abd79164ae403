// The weights of even grids against the elements that they stand for.

#include "discretise/lattice_stencil.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/dense.h"
#include "discretise/grid_space.h"

namespace pelage {
namespace {

Grid even_grid(std::array<std::int32_t, 3> count, std::array<bool, 3> periodic) {
  Grid grid;
  grid.count = count;
  grid.periodic = periodic;
  grid.spacing = {0.1, 0.13, 0.07};
  return grid;
}

/// The number of a node's neighbour, around the ends or as mirrored there.
std::int32_t neighbour(const Grid& grid, std::int32_t node, std::size_t n) {
  const std::array<int, 3> step = {static_cast<int>(n % 3) - 1, static_cast<int>(n / 3 % 3) - 1,
                                   static_cast<int>(n / 9) - 1};
  std::array<std::int32_t, 3> place = {node % grid.count[0], node / grid.count[0] % grid.count[1],
                                       node / grid.count[0] / grid.count[1]};
  for (std::size_t a = 0; a < 3; ++a) {
    std::int32_t& i = place[a];
    i += step[a];
    if (grid.periodic[a]) i = (i + grid.count[a]) % grid.count[a];
    if (i < 0) i = std::min(1, grid.count[a] - 1);
    if (i >= grid.count[a]) i = std::max(0, grid.count[a] - 2);
  }
  return grid.node(place[0], place[1], place[2]);
}

Vector times(const Grid& grid, const std::array<double, 27>& weight, const Vector& u) {
  Vector result = Vector::Zero(u.size());
  for (std::int32_t v = 0; v < u.size(); ++v)
    for (std::size_t n = 0; n < weight.size(); ++n) result[v] += weight[n] * (u[neighbour(grid, v, n)] - u[v]);
  return result;
}

struct Case {
  std::array<std::int32_t, 3> count;
  std::array<bool, 3> periodic;
  Eigen::Matrix3d tensor;
};

class Stencils : public testing::TestWithParam<Case> {};

TEST_P(Stencils, AreWhatTheElementsSay) {
  const auto& [count, periodic, tensor] = GetParam();
  const Grid grid = even_grid(count, periodic);
  const GridSpace space(grid);
  const Tensor t = {tensor(0, 0), tensor(0, 1), tensor(0, 2), tensor(1, 1), tensor(1, 2), tensor(2, 2)};
  const SampledMass sampled = space.sampled(SampleRule::vertices);
  const auto points = static_cast<std::size_t>(space.quadrature_values().rows());
  const SparseMatrix k = space.stiffness(std::vector<Tensor>(points, t));
  const LatticeStencil stencil = lattice_stencil(*space.lattice(), tensor);
  const Vector u = Vector::Random(space.unknowns());
  const Vector& lumped = sampled.sampling->weight;
  const Vector diffusion = -(k * u).cwiseQuotient(lumped), correction = u - (*sampled.mass * u).cwiseQuotient(lumped);
  EXPECT_LT((times(grid, stencil.diffusion, u) - diffusion).cwiseAbs().maxCoeff(),
            1e-12 * diffusion.cwiseAbs().maxCoeff());
  EXPECT_LT((times(grid, stencil.correction, u) - correction).cwiseAbs().maxCoeff(), 1e-12);
}

Eigen::Matrix3d straight() { return Eigen::Vector3d(1, 0.4, 2).asDiagonal(); }
Eigen::Matrix3d full() {
  Eigen::Matrix3d t;
  t << 1, 0.3, 0.1, 0.3, 0.5, -0.2, 0.1, -0.2, 0.8;
  return t;
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Stencils,
                         testing::Values(Case{{17, 1, 1}, {false, false, false}, straight()},
                                         Case{{17, 1, 1}, {true, false, false}, straight()},
                                         Case{{9, 7, 1}, {false, false, false}, straight()},
                                         Case{{9, 7, 1}, {true, false, false}, straight()},
                                         Case{{9, 7, 1}, {true, true, false}, full()},
                                         Case{{5, 6, 4}, {false, true, false}, straight()},
                                         Case{{5, 6, 4}, {true, true, true}, full()}));

/// The largest eigenvalue, found another way.
TEST(Stencils, KnowTheirLargestRate) {
  const Grid grid = even_grid({8, 6, 1}, {true, true, false});
  const GridSpace space(grid);
  for (const int sweeps : {0, 1, 2}) {
    const LatticeStencil stencil = lattice_stencil(*space.lattice(), full());
    Eigen::MatrixXd all(48, 48);
    for (Eigen::Index v = 0; v < 48; ++v) {
      const Vector unit = Vector::Unit(48, v), d = times(grid, stencil.diffusion, unit);
      Vector sum = d;
      for (int s = 0; s < sweeps; ++s) sum = d + times(grid, stencil.correction, sum);
      all.col(v) = sum;
    }
    const double largest = eigenvalues(all).cwiseAbs().maxCoeff();
    EXPECT_NEAR(largest_rate(stencil, sweeps) / largest, 1, 0.03) << sweeps;
    EXPECT_GE(largest_rate(stencil, sweeps), largest * (1 - 1e-9));
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
