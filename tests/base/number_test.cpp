#include "base/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "base/random.h"
#include "support/decimal_comma.h"

namespace pelage {
namespace {

TEST(Number, IsShortAtEverySize) {
  EXPECT_EQ(number(0.03125), "0.03125");
  EXPECT_EQ(number(1.5e-7), "1.5e-07");
  EXPECT_EQ(number(-1e300), "-1e+300");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "nan");
}

/// printf's conversions in the classic locale are the definition.
TEST(Number, IsThatOfPrintf) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double value = (uniform(1, i) - 0.5) * std::pow(10.0, std::floor(40 * uniform(2, i) - 20));
    for (const int digits : {1, 4, 6, 17}) {
      char general[64], fixed[64];
      std::snprintf(general, sizeof general, "%.*g", digits, value);
      std::snprintf(fixed, sizeof fixed, "%.*f", digits, value);
      EXPECT_EQ(number(value, digits), general);
      EXPECT_EQ(fixed_number(value, digits), fixed);
    }
  }
  EXPECT_EQ(fixed_number(1e308, 40).size(), 309 + 1 + 40);
}

TEST(Number, HasAPointInEveryLocale) {
  const testing::DecimalComma elsewhere;
  EXPECT_EQ(number(1234.5), "1234.5");
  EXPECT_EQ(exact_number(1234.5), "1234.5");
  EXPECT_EQ(fixed_number(1234.5, 2), "1234.50");
}

}  // namespace
}  // namespace pelage
