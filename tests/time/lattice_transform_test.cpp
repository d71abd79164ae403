#include "time/lattice_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"

namespace pelage {
namespace {

using std::numbers::pi;

Lattice lattice_of(std::array<std::size_t, 3> count, std::array<bool, 3> periodic) {
  return {count, periodic, {0.5, 0.25, 0.125}};
}

template <class Real>
std::vector<Real> noise(std::size_t n) {
  std::vector<Real> x(n);
  for (std::size_t k = 0; k < n; ++k) x[k] = static_cast<Real>(uniform(1, k) - 0.3);
  return x;
}

/// Even, odd, prime and large prime counts; closed, mixed, 1 to 3 axes.
const std::vector<Lattice> lattices = {
    lattice_of({16, 1, 1}, {true, false, false}), lattice_of({67, 1, 1}, {true, false, false}),
    lattice_of({134, 3, 1}, {true, true, false}), lattice_of({9, 1, 1}, {false, false, false}),
    lattice_of({2, 1, 1}, {false, false, false}), lattice_of({12, 10, 1}, {true, true, false}),
    lattice_of({7, 71, 1}, {true, true, false}),  lattice_of({12, 6, 1}, {false, true, false}),
    lattice_of({11, 6, 1}, {true, false, false}), lattice_of({11, 69, 1}, {false, false, false}),
    lattice_of({4, 5, 6}, {true, true, true}),    lattice_of({4, 5, 6}, {false, true, true}),
    lattice_of({5, 4, 3}, {false, false, false}), lattice_of({3, 4, 5}, {true, false, true})};

template <class Real>
void expect_return(double tolerance) {
  for (const Lattice& lattice : lattices) {
    const LatticeTransform<Real> t(lattice);
    const std::vector<Real> field = noise<Real>(lattice.nodes());
    std::vector<Real> waves(t.size()), back(lattice.nodes());
    t.forward(field.data(), waves.data());
    t.inverse(waves.data(), back.data());
    for (std::size_t k = 0; k < field.size(); ++k) ASSERT_NEAR(back[k], field[k], tolerance) << lattice.count[0];
  }
}

TEST(LatticeTransform, ThereAndBack) {
  expect_return<double>(4e-15);
  expect_return<float>(2e-6);
}

/// The field of a wave has its place in the sums, and k . T k of that place is what the wave's derivatives say.
TEST(LatticeTransform, KnowsTheWaveNumbers) {
  Eigen::Matrix3d tensor;
  tensor << 2, 0.7, 0, 0.7, 1, 0, 0, 0, 1;
  const Lattice lattice = lattice_of({24, 18, 1}, {true, true, false});
  const LatticeTransform<double> t(lattice);
  const std::vector<double> form = t.quadratic_form(tensor);
  for (const auto& [mx, my] : {std::pair{0, 0}, {3, 0}, {0, 5}, {2, 5}, {2, -5}, {7, 8}, {11, -1}}) {
    std::vector<double> field(lattice.nodes()), waves(t.size());
    for (std::size_t k = 0; k < field.size(); ++k)
      field[k] = std::cos(2 * pi * (mx * static_cast<double>(k % 24) / 24 + my * static_cast<double>(k / 24) / 18) + 1);
    t.forward(field.data(), waves.data());
    const Eigen::Vector3d wave(2 * pi * mx / (24 * 0.5), 2 * pi * my / (18 * 0.25), 0);
    for (std::size_t w = 0; w < t.waves(); ++w)
      if (std::hypot(waves[2 * w], waves[2 * w + 1]) > 1e-10 * static_cast<double>(field.size())) {
        EXPECT_NEAR(form[w], wave.dot(tensor * wave), 1e-10) << mx << " " << my;
      }
  }
}

/// The shortest wave of a row of even count goes both ways: it has no mixed term.
TEST(LatticeTransform, LeavesMixedTermsOutWhereTheyHaveNoSign) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Identity();
  const LatticeTransform<double> t(lattice_of({6, 8, 1}, {true, true, false}));
  const std::vector<double> plain = t.quadratic_form(tensor);
  tensor(0, 1) = tensor(1, 0) = 0.5;
  const std::vector<double> tilted = t.quadratic_form(tensor);
  EXPECT_EQ(plain[3 + 4 * 2], tilted[3 + 4 * 2]);  // the last of the row
  EXPECT_EQ(plain[1 + 4 * 4], tilted[1 + 4 * 4]);  // the last of the column
  EXPECT_NE(plain[1 + 4 * 2], tilted[1 + 4 * 2]);
}

/// Closed: as the field continued by its mirror image, periodically.
TEST(LatticeTransform, ClosedAxesAreMirrors) {
  const std::size_t n = 9, m = 6, whole = 2 * (n - 1);
  const LatticeTransform<double> closed(lattice_of({n, m, 1}, {false, true, false}));
  const LatticeTransform<double> doubled(lattice_of({whole, m, 1}, {true, true, false}));
  const std::vector<double> field = noise<double>(n * m);
  std::vector<double> mirrored(whole * m), a(closed.size()), b(doubled.size());
  for (std::size_t k = 0; k < mirrored.size(); ++k) {
    const std::size_t i = k % whole;
    mirrored[k] = field[std::min(i, whole - i) + n * (k / whole)];
  }
  closed.forward(field.data(), a.data());
  doubled.forward(mirrored.data(), b.data());
  EXPECT_NEAR(closed.mean_square(a), doubled.mean_square(b), 1e-14);
  const std::vector<double> form = closed.quadratic_form(Eigen::Matrix3d::Identity()),
                            form_of_doubled = doubled.quadratic_form(Eigen::Matrix3d::Identity());
  ASSERT_EQ(closed.waves(), n * (m / 2 + 1));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= m / 2; ++j) {
      EXPECT_NEAR(form[i + n * j], form_of_doubled[i + n * j], 1e-12);
      for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(a[2 * (i + n * j) + c], b[2 * (i + n * j) + c], 1e-13);
    }
}

TEST(LatticeTransform, KeepsTheMeanSquare) {
  for (const Lattice& lattice : lattices) {
    const LatticeTransform<double> t(lattice);
    const std::vector<double> field = noise<double>(lattice.nodes());
    std::vector<double> waves(t.size());
    t.forward(field.data(), waves.data());
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < field.size(); ++k) {
      const std::array<std::size_t, 3> place = {k % lattice.count[0], k / lattice.count[0] % lattice.count[1],
                                                k / lattice.count[0] / lattice.count[1]};
      double weight = 1;
      for (int a = 0; a < 3; ++a)
        if (lattice.count[a] > 1 && !lattice.periodic[a] && (place[a] == 0 || place[a] + 1 == lattice.count[a]))
          weight /= 2;
      sum += weight * field[k] * field[k];
      weights += weight;
    }
    EXPECT_NEAR(t.mean_square(waves) / (sum / weights), 1, 1e-12) << lattice.count[0] << " " << lattice.count[1];
  }
}

TEST(LatticeTransform, TheSameBitsForAnyNumberOfThreads) {
  const LatticeTransform<double> t(lattice_of({134, 130, 1}, {true, false, false}));
  const std::vector<double> field = noise<double>(134 * 130);
  std::vector<double> one(t.size()), two(t.size());
  {
    const ThreadLimit limit(1);
    t.forward(field.data(), one.data());
  }
  t.forward(field.data(), two.data());
  EXPECT_EQ(one, two);
}

}  // namespace
}  // namespace pelage
