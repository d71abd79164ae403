#include "render/studio.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/sampler.h"

namespace pelage {
namespace {

using Eigen::Vector3f;

TEST(Studio, CosineDirectionsHaveTheirDensity) {
  // Means over the density cos / pi: of the direction 2/3 n, of the squared cosine 1/2.
  for (const Vector3f& axis : {Vector3f(0, 0, 1), Vector3f(0, 0, -1), Vector3f(0.6F, -0.8F, 0), Vector3f(1, 2, -3)}) {
    const Vector3f n = axis.normalized();
    Vector3f mean = Vector3f::Zero();
    float square = 0;
    constexpr int count = 4096;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vector3f d = cosine_direction(n, scrambled_sobol(i, 3));
      EXPECT_NEAR(d.norm(), 1, 1e-5F);
      EXPECT_GE(d.dot(n), -1e-6F);
      mean += d / count;
      square += d.dot(n) * d.dot(n) / count;
    }
    EXPECT_LT((mean - n * 2 / 3).norm(), 2e-3F);
    EXPECT_NEAR(square, 0.5F, 2e-3F);
  }
}

TEST(Studio, KeyLampStandsAboveLeftOfTheCameraAndTurnsWithIt) {
  for (float angle : {0.0F, 1.0F, 4.0F}) {
    const Vector3f back(std::sin(angle), 0, std::cos(angle)), right(std::cos(angle), 0, -std::sin(angle));
    const Studio studio(back, Vector3f::Ones());
    for (std::uint32_t i = 0; i < 64; ++i) {
      const Vector3f d = studio.key_direction(scrambled_sobol(i, 3));
      EXPECT_NEAR(d.norm(), 1, 1e-5F);
      EXPECT_GT(d.y(), 0.3F);
      EXPECT_LT(d.dot(right), 0);
      EXPECT_GT(d.dot(back), 0);
    }
  }
}

TEST(Studio, AWhiteFloorIsNearlyWhite) {
  const Studio studio(Vector3f::UnitZ(), Vector3f::Ones());
  Vector3f light = Vector3f::Zero();
  constexpr int count = 1024;
  for (std::uint32_t i = 0; i < count; ++i)
    light += (studio.room(cosine_direction(Vector3f::UnitY(), scrambled_sobol(i, 1))) +
              studio.key() * studio.key_direction(scrambled_sobol(i, 2)).y()) /
             count;
  for (float c : light) EXPECT_NEAR(c, 1, 0.1F);
}

/// Directions all over the sphere.
std::vector<Vector3f> directions() {
  std::vector<Vector3f> all;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const auto [u, v] = scrambled_sobol(i, 9);
    const float y = 2 * u - 1, angle = 6.2831853F * v, radius = std::sqrt(1 - y * y);
    all.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
  }
  return all;
}

TEST(Studio, CosineAndPointsOfTheKeyLampAreMeansOverIt) {
  const Studio studio(Vector3f(0.6F, 0, 0.8F), Vector3f::Ones());
  for (const Vector3f& n : directions()) {
    float cosine = 0, cube = 0, rule = 0;
    constexpr int count = 4096;
    const auto third_power = [&](const Vector3f& d) { return std::pow(d.dot(n), 3.0F); };
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vector3f d = studio.key_direction(scrambled_sobol(i, 2));
      cosine += std::max(0.0F, d.dot(n)) / count;
      cube += third_power(d) / count;
    }
    for (const Studio::LampPoint& p : studio.key_points()) rule += p.weight * third_power(p.direction);
    EXPECT_NEAR(studio.key_cosine(n), cosine, 1e-3F);
    EXPECT_NEAR(rule, cube, 1e-3F);
  }
}

TEST(Studio, OpenIrradianceIsTheMeanOverTheHemisphere) {
  const Studio studio(Vector3f(0.6F, 0, 0.8F), Vector3f(0.9F, 0.5F, 0.2F));
  for (const Vector3f& n : directions()) {
    Vector3f mean = Vector3f::Zero();
    constexpr int count = 1 << 14;
    for (std::uint32_t i = 0; i < count; ++i) mean += studio.open(cosine_direction(n, scrambled_sobol(i, 3))) / count;
    EXPECT_LT((studio.open_irradiance(n) - mean).norm(), 0.004F * mean.norm()) << n.transpose();
  }
}

}  // namespace
}  // namespace pelage
