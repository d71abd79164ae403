#include "react/diffusion_tensor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "base/random.h"

namespace pelage {
namespace {

std::array<double, 6> entries(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

/// Q diag(values) Q' with a random rotation.
std::array<double, 6> turned(const Eigen::Vector3d& values, std::uint64_t seed) {
  Eigen::Matrix3d random;
  for (int i = 0; i < 9; ++i) random(i / 3, i % 3) = uniform(seed, static_cast<std::uint64_t>(i)) - 0.5;
  const Eigen::Matrix3d q = Eigen::HouseholderQR<Eigen::Matrix3d>(random).householderQ();
  return entries(q * values.asDiagonal() * q.transpose());
}

TEST(DiffusionTensor, HasNoNegativeEigenvalue) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    for (const double scale : {1e-9, 1.0, 1e9}) {
      for (const Eigen::Vector3d& good :
           {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 1e-3, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 0)})
        EXPECT_TRUE(positive_semidefinite(turned(scale * good, seed))) << good.transpose();
      for (const Eigen::Vector3d& bad : {Eigen::Vector3d(1, 2, -1e-3), Eigen::Vector3d(1, -1e-6, 0),
                                         Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, -1, -1)})
        EXPECT_FALSE(positive_semidefinite(turned(scale * bad, seed))) << bad.transpose();
    }
}

TEST(DiffusionTensor, HasNoNegativeMinor) {
  for (const std::array<double, 6>& tensor : {std::array<double, 6>{1, 2, 0, 1, 0, 0},
                                              {1, 0, 2, 0, 0, 1},
                                              {0, 0, 0, 1, 2, 1},
                                              {-1, 0, 0, 0, 0, 0},
                                              {0, 0, 0, -1, 0, 0},
                                              {0, 0, 0, 0, 0, -1}})
    EXPECT_FALSE(positive_semidefinite(tensor));
}

TEST(DiffusionTensor, IsFinite) {
  EXPECT_FALSE(positive_semidefinite({1, 0, 0, 1, 0, std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(positive_semidefinite({1, 0, 0, std::numeric_limits<double>::infinity(), 0, 1}));
}

}  // namespace
}  // namespace pelage
