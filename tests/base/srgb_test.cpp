#include "base/srgb.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace pelage
