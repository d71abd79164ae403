// The stencil of even grids as loops over pairs of species, against its definition, node by node.

#include "time/paired_nodes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace pelage {
namespace {

/// Of a node beyond the ends: around them, or as mirrors on the first and the last node show it.
std::size_t seen(std::int64_t i, std::size_t n, bool periodic) {
  const std::int64_t period = periodic ? static_cast<std::int64_t>(n) : std::max<std::int64_t>(1, 2 * (n - 1));
  i = ((i % period) + period) % period;
  return static_cast<std::size_t>(std::min(i, periodic ? i : period - i));
}

PairedStencil stencil_of(std::array<std::size_t, 3> count, std::array<bool, 3> periodic) {
  PairedStencil s{count, periodic, {}};
  for (const std::array<int, 3>& direction : {std::array{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -1, 0}, {0, 1, 1}})
    for (int steps = 1; steps <= 2; ++steps) {
      const auto n = static_cast<float>(s.neighbours.size());
      s.neighbours.push_back(
          {{steps * direction[0], steps * direction[1], steps * direction[2]}, {1 + n / 7, 0.3f - n / 5}});
    }
  return s;
}

double expected(const PairedStencil& s, const PairField& x, std::size_t node, std::size_t lane) {
  const auto& n = s.count;
  const std::array<std::size_t, 3> place = {node % n[0], node / n[0] % n[1], node / n[0] / n[1]};
  double sum = 0;
  for (const auto& [step, weight] : s.neighbours)
    for (const int sign : {1, -1}) {
      std::array<std::size_t, 3> to{};
      for (std::size_t a = 0; a < 3; ++a)
        to[a] = seen(static_cast<std::int64_t>(place[a]) + sign * step[a], n[a], s.periodic[a]);
      const std::size_t other = to[0] + n[0] * (to[1] + n[1] * to[2]);
      sum += weight[lane] * (static_cast<double>(x[2 * other + lane]) - x[2 * node + lane]);
    }
  return sum;
}

SlicedMatrix matrix_of(std::array<std::size_t, 3> count, std::array<bool, 3> periodic) {
  SlicedMatrix m;
  m.rows = count[0] * count[1] * count[2];
  m.stencil = stencil_of(count, periodic);
  return m;
}

PairField noise(std::size_t nodes) {
  PairField x(2 * padded(nodes));
  for (std::size_t k = 0; k < 2 * nodes; ++k) x[k] = static_cast<float>(uniform(3, k));
  return x;
}

struct Case {
  std::array<std::size_t, 3> count;
  std::array<bool, 3> periodic;
};

class PairedStencils : public testing::TestWithParam<Case> {};

TEST_P(PairedStencils, AreWhatTheyAreDefinedAsInAllPiecesAndInstructions) {
  const SlicedMatrix m = matrix_of(GetParam().count, GetParam().periodic);
  const PairField x = noise(m.rows);
  const std::array<float, 2> scale = {2, -1};
  for (const InstructionSet set : instruction_sets()) {
    PairField all(2 * padded(m.rows)), part(2 * padded(m.rows));
    node_loops(set).diffuse(m, x.data(), scale.data(), 0, m.slices(), all.data());
    for (std::size_t s = 0; s < m.slices(); s += 3)
      node_loops(set).diffuse(m, x.data(), scale.data(), s, std::min(s + 3, m.slices()),
                              part.data() + 2 * slice_rows * s);
    EXPECT_EQ(all, part);
    for (std::size_t k = 0; k < 2 * m.rows; ++k)
      ASSERT_NEAR(all[k], scale[k % 2] * expected(*m.stencil, x, k / 2, k % 2), 2e-5) << k;
    PairField baseline(all.size());
    node_loops(InstructionSet::baseline).diffuse(m, x.data(), scale.data(), 0, m.slices(), baseline.data());
    EXPECT_EQ(all, baseline);
  }
}

TEST_P(PairedStencils, ConstantsHaveNoRate) {
  const SlicedMatrix m = matrix_of(GetParam().count, GetParam().periodic);
  PairField x(2 * padded(m.rows), 0.7f), out(x.size());
  const std::array<float, 2> one = {1, 1};
  node_loops(best_instruction_set()).diffuse(m, x.data(), one.data(), 0, m.slices(), out.data());
  EXPECT_EQ(out, PairField(out.size(), 0.0f));
}

constexpr std::array<bool, 3> closed = {false, false, false}, around = {true, true, true};
INSTANTIATE_TEST_SUITE_P(AllKinds, PairedStencils,
                         testing::Values(Case{{2, 1, 1}, closed}, Case{{3, 1, 1}, around}, Case{{97, 1, 1}, closed},
                                         Case{{97, 1, 1}, around}, Case{{3, 2, 1}, closed}, Case{{3, 3, 1}, around},
                                         Case{{37, 11, 1}, closed}, Case{{64, 16, 1}, around},
                                         Case{{130, 9, 1}, {true, false, false}}, Case{{5, 6, 4}, around},
                                         Case{{33, 2, 5}, {false, false, true}}));

/// A tile has no first node.
TEST(PairedStencils, AMovedFieldHasTheMovedRatesToTheLastBit) {
  const std::size_t nx = 45, ny = 22, dx = 7, dy = 5;
  const SlicedMatrix m = matrix_of({nx, ny, 1}, around);
  const PairField x = noise(m.rows);
  PairField moved(x.size()), rates(x.size()), of_moved(x.size());
  const auto from = [&](std::size_t k) {
    const std::size_t i = k / 2 % nx, j = k / 2 / nx;
    return 2 * ((i + dx) % nx + nx * ((j + dy) % ny)) + k % 2;
  };
  for (std::size_t k = 0; k < 2 * m.rows; ++k) moved[k] = x[from(k)];
  const std::array<float, 2> one = {1, 1};
  const NodeLoops& loops = node_loops(best_instruction_set());
  loops.diffuse(m, x.data(), one.data(), 0, m.slices(), rates.data());
  loops.diffuse(m, moved.data(), one.data(), 0, m.slices(), of_moved.data());
  for (std::size_t k = 0; k < 2 * m.rows; ++k) ASSERT_EQ(of_moved[k], rates[from(k)]);
}

}  // namespace
}  // namespace pelage
