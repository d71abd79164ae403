#include "render/gloss.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/sampler.h"
#include "render/studio.h"

namespace pelage {
namespace {

using Eigen::Vector3f;

TEST(Gloss, HighlightIsTheSameFromBothEndsOfTheRay) {
  const Vector3f n(0, 1, 0), a = Vector3f(0.3F, 0.8F, 0.1F).normalized(), b = Vector3f(-0.6F, 0.5F, 0.2F).normalized();
  EXPECT_NEAR(highlight(n, a, b) / n.dot(b), highlight(n, b, a) / n.dot(a), 1e-6F);
}

TEST(Gloss, HighlightIsBrightestInTheMirrorAndZeroBehindTheSurface) {
  const Vector3f n(0, 1, 0), view = Vector3f(0.5F, 1, 0).normalized();
  const float mirror = highlight(n, view, Vector3f(-0.5F, 1, 0).normalized());
  EXPECT_GT(mirror, 20 * highlight(n, view, Vector3f(0.8F, 0.7F, 0.6F).normalized()));
  EXPECT_EQ(highlight(n, view, Vector3f(0.5F, -1, 0).normalized()), 0);
}

TEST(Gloss, NoMoreLightIsReflectedThanArrives) {
  // Under an even sky of radiance 1, whose irradiance over pi is 1: the mean of highlight / cosine over cos / pi.
  const Vector3f n(0, 1, 0);
  for (float slope : {0.0F, 0.5F, 2.0F, 6.0F}) {
    const Vector3f view = Vector3f(slope, 1, 0).normalized();
    float sum = 0;
    constexpr int count = 1 << 14;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vector3f light = cosine_direction(n, scrambled_sobol(i, 5));
      sum += highlight(n, view, light) / std::max(1e-3F, n.dot(light)) / count;
    }
    EXPECT_GT(sum, 0.02F);
    EXPECT_LT(sum + sheen(1), 1) << slope;
  }
}

}  // namespace
}  // namespace pelage
