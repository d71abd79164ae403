#include "base/number.h"

#include <gtest/gtest.h>

#include <limits>

namespace pelage {
namespace {

TEST(Number, IsShortAtEverySize) {
  EXPECT_EQ(number(0.03125), "0.03125");
  EXPECT_EQ(number(1.5e-7), "1.5e-07");
  EXPECT_EQ(number(-1e300), "-1e+300");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace pelage
