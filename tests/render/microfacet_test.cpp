#include "render/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/sampler.h"

namespace pelage {
namespace {

using Eigen::Vector3f;

Finish finish(float roughness, float metalness) {
  Finish f;
  f.roughness = roughness;
  f.metalness = metalness;
  return f;
}

Vector3f towards(double cosine, double angle = 0) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return Vector3f(static_cast<float>(sine * std::cos(angle)), static_cast<float>(sine * std::sin(angle)),
                  static_cast<float>(cosine));
}

/// All that a surface sends towards a view in even light, by the midpoint rule over the normals of facets, which
/// resolves the mirrored peak: half vectors (t, phi) with light = their mirror image, d light = 4 (view . half) d half.
double furnace(const Vector3f& color, const Finish& f, const Vector3f& view) {
  const Reflection surface(color, f);
  constexpr int around = 256, down = 2048;
  double mirrored = 0, rest = 0;
  for (int i = 0; i < down; ++i)
    for (int j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * (j + 0.5) / around;
      // Denser near the pole: tan of the normal's angle = t / (1 - t) * alpha.
      const double alpha = std::max(1e-3, static_cast<double>(f.roughness) * f.roughness), t = (i + 0.5) / down;
      const double slope = alpha * t / (1 - t), cosine = 1 / std::sqrt(1 + slope * slope);
      const double step = alpha / ((1 - t) * (1 - t)) / down;  // d slope; d half = slope cosine^3 d slope d angle
      const Vector3f half = towards(cosine, angle);
      const float seen = view.dot(half);
      const Vector3f light = 2 * seen * half - view;
      if (seen > 0 && light.z() > 0)
        mirrored += 4 * seen * slope * std::pow(cosine, 3) * step * (2 * std::numbers::pi / around) *
                    surface.mirrored(view, light)[0] * light.z();
      if (i % 16 != 0) continue;
      const Vector3f even = towards((i / 16 + 0.5) / (down / 16), angle);
      rest += (surface.brdf(view, even) - surface.mirrored(view, even))[0] * even.z() * 2 * std::numbers::pi / around /
              (down / 16);
    }
  EXPECT_NEAR(rest, surface.scattered(view.z())[0], 0.003);
  return mirrored + rest;
}

TEST(Reflection, WhiteSurfacesDisappearInEvenLight) {
  for (const float metalness : {0.0F, 1.0F})
    for (const float roughness : {0.1F, 0.3F, 0.5F, 0.8F, 1.0F})
      for (const double cosine : {0.1, 0.4, 0.8, 1.0})
        EXPECT_NEAR(furnace(Vector3f::Ones(), finish(roughness, metalness), towards(cosine)), 1, 0.01)
            << "metalness " << metalness << ", roughness " << roughness << ", cosine " << cosine;
}

TEST(Reflection, NothingComesOutOfDarkGroundButWhatIsMirrored) {
  EXPECT_LT(furnace(Vector3f::Zero(), finish(0.8F, 0), towards(1)), 0.05);
  EXPECT_EQ(furnace(Vector3f::Zero(), finish(0.8F, 1), towards(0.1)) < 0.5, true);
}

TEST(Reflection, IsTheSameBothWays) {
  const Vector3f color(0.9F, 0.5F, 0.1F);
  for (std::uint32_t k = 0; k < 200; ++k) {
    const auto [a, b] = scrambled_sobol(k, 1);
    const auto [c, d] = scrambled_sobol(k, 2);
    const auto [roughness, metalness] = scrambled_sobol(k, 3);
    const Vector3f view = towards(0.02 + 0.98 * a, 6 * b), light = towards(0.02 + 0.98 * c, 6 * d);
    const Reflection surface(color, finish(roughness, metalness));
    const Vector3f there = surface.brdf(view, light), back = surface.brdf(light, view);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(there[i], back[i], 1e-4F * std::max(1.0F, there[i]));
  }
}

/// Sampled normals and the density of what they mirror say the same: the mean of one over the other is the integral.
TEST(Facets, SamplesFollowTheirDensity) {
  for (const float roughness : {0.3F, 0.7F, 1.0F}) {
    const Facets facets(roughness);
    const Vector3f view = towards(0.5);
    constexpr std::uint32_t count = 1 << 14;
    double mean = 0, integral = 0;
    const auto weight = [](const Vector3f& l) { return std::exp(l.x() + 2 * l.y()); };
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto numbers = scrambled_sobol(k, 7);
      const Vector3f half = facets.visible_normal(view, numbers);
      EXPECT_NEAR(half.norm(), 1, 1e-5);
      mean += weight(2 * view.dot(half) * half - view) / count;
      const Vector3f any = towards(2 * numbers[0] - 1, 2 * std::numbers::pi * numbers[1]);
      if ((any + view).z() > 0)
        integral += 4 * std::numbers::pi * facets.mirrored_density(view, any) * weight(any) / count;
    }
    EXPECT_NEAR(mean, integral, 0.02 * integral) << roughness;
  }
}

/// What is transmitted, by Fresnel's own amplitudes, is what is not reflected.
TEST(Glass, ReflectsAndTransmitsAll) {
  for (const double n : {1.5, 1 / 1.5})
    for (double cosine = 0.02; cosine <= 1; cosine += 0.07) {
      const double sine = std::sqrt(1 - cosine * cosine) / n;
      const float reflected = glass_reflectance(static_cast<float>(cosine), static_cast<float>(n));
      if (sine >= 1) {
        EXPECT_EQ(reflected, 1);
        continue;
      }
      const double behind = std::sqrt(1 - sine * sine);
      const double s = 2 * cosine / (cosine + n * behind), p = 2 * cosine / (n * cosine + behind);
      const double transmitted = n * behind / cosine * (s * s + p * p) / 2;
      EXPECT_NEAR(reflected + transmitted, 1, 1e-5) << n << " " << cosine;
    }
  EXPECT_NEAR(glass_reflectance(1, glass_index), 0.04F, 1e-6F);
}

}  // namespace
}  // namespace pelage
