#include "linalg/harmonic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "pelage/error.h"

namespace pelage {
namespace {

/// The stiffness of resistors in a row, the k-th with this conductance between the nodes k and k + 1.
SharedMatrix resistors(const std::vector<double>& conductance) {
  const auto n = static_cast<std::int32_t>(conductance.size()) + 1;
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = n;
  std::vector<double> value;
  for (std::int32_t i = 0; i < n; ++i) {
    const double left = i > 0 ? conductance[static_cast<std::size_t>(i - 1)] : 0;
    const double right = i + 1 < n ? conductance[static_cast<std::size_t>(i)] : 0;
    for (const auto& [j, k] : {std::pair(i - 1, -left), {i, left + right}, {i + 1, -right}}) {
      if (j < 0 || j >= n) continue;
      pattern->column.push_back(j);
      value.push_back(k);
    }
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  return std::make_shared<const SparseMatrix>(SparseMatrix{std::move(pattern), std::move(value)});
}

/// What flows through resistors in a row is the same everywhere: voltages fall as resistances add up.
TEST(Harmonic, VoltagesAlongResistors) {
  std::vector<double> conductance;
  for (int k = 0; k < 60; ++k) conductance.push_back(1 + 0.8 * std::sin(k));
  Held held(61, 0);
  held.front() = held[50] = 1;
  Vector u = Vector::Zero(61);
  u[0] = 7, u[50] = -2;
  HarmonicFunctions(resistors(conductance), held).complete(u, 1e-12);
  const auto resistance = [&](int end) {
    return std::accumulate(conductance.begin(), conductance.begin() + end, 0.0,
                           [](double sum, double c) { return sum + 1 / c; });
  };
  for (int k = 0; k <= 50; ++k) EXPECT_NEAR(u[k], 7 - 9 * resistance(k) / resistance(50), 1e-9) << k;
  for (int k = 51; k <= 60; ++k) EXPECT_NEAR(u[k], -2, 1e-9) << k;  // nothing flows beyond
}

TEST(Harmonic, SaysWhereThereIsNone) {
  Vector u = Vector::Zero(4);
  u[0] = 1;
  const HarmonicFunctions none(resistors({1, -1, 1}), {1, 0, 0, 1});
  EXPECT_THROW(none.complete(u, 1e-12), Error);
}

}  // namespace
}  // namespace pelage
