#include "base/checked.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace pelage {
namespace {

template <class Integer>
void expect_saturation() {
  using Limits = std::numeric_limits<Integer>;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(saturated<Integer>(0.99), 0);
  EXPECT_EQ(saturated<Integer>(100.5), 100);
  EXPECT_EQ(saturated<Integer>(std::numeric_limits<double>::quiet_NaN()), 0);
  for (const double x : {infinity, 1e300, static_cast<double>(Limits::max()) + 1})
    EXPECT_EQ(saturated<Integer>(x), Limits::max()) << x;
  for (const double x : {-infinity, -1e300, static_cast<double>(Limits::min())})
    EXPECT_EQ(saturated<Integer>(x), Limits::min()) << x;
}

TEST(Checked, NumbersSaturateAtTheEndsOfTheIntegers) {
  expect_saturation<std::int8_t>();
  expect_saturation<std::int32_t>();
  expect_saturation<std::int64_t>();
  expect_saturation<std::uint64_t>();
  EXPECT_EQ(saturated<std::int32_t>(2147483646.5), 2147483646);
  EXPECT_EQ(saturated<std::int32_t>(-2147483647.5), -2147483647);
  EXPECT_EQ(saturated<std::int64_t>(0x1.fffffffffffffp62), 9223372036854774784);  // the largest below 2^63
}

TEST(Checked, CountsThatHaveNoRoomAreRefused) {
  EXPECT_EQ(checked_count<std::int32_t>(std::size_t{2147483647}, "things"), 2147483647);
  try {
    checked_count<std::int32_t>(std::size_t{2147483648}, "things");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_STREQ(error.what(), "too many things: 2147483648, at most 2147483647 can be used; take a smaller mesh");
  }
}

}  // namespace
}  // namespace pelage
