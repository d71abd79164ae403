#include "base/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelage {
namespace {

TEST(Srgb, InverseOfEachOther) {
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(linear_from_srgb(srgb_from_linear(i / 1000.0)), i / 1000.0, 1e-7);
}

TEST(Srgb, EveryByteSurvives) {
  for (int i = 0; i < 256; ++i) EXPECT_EQ(srgb_byte(linear_from_srgb(i / 255.0)), i);
}

TEST(Srgb, KnownValuesAndClamping) {
  EXPECT_NEAR(srgb_from_linear(0.2140411), 0.5, 1e-6);  // the middle grey of the standard
  EXPECT_EQ(srgb_byte(-1), 0);
  EXPECT_EQ(srgb_byte(7), 255);
}

TEST(Srgb, TablesGiveTheSameBytes) {
  const SrgbBytes bytes;
  for (int i = 0; i <= 100'000; ++i) {
    const float light = static_cast<float>(i) / 90'000 - 0.05F;
    ASSERT_EQ(bytes(light), srgb_byte(static_cast<double>(light))) << light;
  }
  for (int byte = 1; byte < 256; ++byte) {  // around every step
    float light = static_cast<float>(linear_from_srgb((byte - 0.5) / 255));
    for (int k = 0; k < 20; ++k) light = std::nextafter(light, 0.0F);
    for (int k = 0; k < 40; ++k, light = std::nextafter(light, 1.0F))
      ASSERT_EQ(bytes(light), srgb_byte(static_cast<double>(light))) << byte;
  }
}

}  // namespace
}  // namespace pelage
