#include "look/ramp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/srgb.h"
#include "pelage/error.h"

namespace pelage {
namespace {

double distance(const Color& a, const Color& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

TEST(Ramp, OklabKnownValues) {  // table of Ottosson 2020, from CIE XYZ by way of linear sRGB
  EXPECT_LT(distance(oklab_from_linear({1, 1, 1}), {1, 0, 0}), 1e-6);
  EXPECT_LT(distance(oklab_from_linear({1, 0, 0}), {0.62796, 0.22486, 0.12585}), 1e-4);
  EXPECT_LT(distance(oklab_from_linear({0, 0, 1}), {0.45201, -0.03246, -0.31153}), 1e-4);
}

TEST(Ramp, OklabInverse) {
  for (double r : {0.0, 0.2, 1.0})
    for (double g : {0.0, 0.5, 1.0})
      for (double b : {0.01, 0.7})
        EXPECT_LT(distance(linear_from_oklab(oklab_from_linear({r, g, b})), {r, g, b}), 1e-6);
}

TEST(Ramp, PassesThroughItsStops) {
  for (const std::string& name : ramp_names()) {
    const Ramp ramp = named_ramp(name);
    ASSERT_GE(ramp.stops.size(), 2U);
    EXPECT_EQ(ramp.stops.front().at, 0) << name;
    EXPECT_EQ(ramp.stops.back().at, 1) << name;
    for (std::size_t i = 0; i < ramp.stops.size(); ++i) {
      EXPECT_TRUE(i == 0 || ramp.stops[i].at > ramp.stops[i - 1].at) << name;
      EXPECT_LT(distance(ramp(ramp.stops[i].at), ramp.stops[i].color), 1e-6) << name << " " << i;
    }
    EXPECT_LT(distance(ramp(-3), ramp(0)), 1e-6);
    EXPECT_LT(distance(ramp(5), ramp(1)), 1e-6);
  }
}

TEST(Ramp, HalfwayLooksHalfway) {
  const Ramp ramp = named_ramp("mono");
  const auto low = oklab_from_linear(ramp(0)), high = oklab_from_linear(ramp(1)), middle = oklab_from_linear(ramp(0.5));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(middle[k], (low[k] + high[k]) / 2, 1e-6);
}

TEST(Ramp, ScienceIsEvenAndOnTheScreen) {
  const Ramp ramp = named_ramp("science");
  for (const Stop& stop : ramp.stops)
    for (double c : stop.color) EXPECT_TRUE(c >= -0.002 && c <= 1.002) << stop.at << ": " << c;
  for (int i = 0; i < 100; ++i) {
    const double step = oklab_from_linear(ramp((i + 1) / 100.0))[0] - oklab_from_linear(ramp(i / 100.0))[0];
    EXPECT_NEAR(step, 0.0067, 0.001) << i;
  }
}

TEST(Ramp, HexColours) {
  const Color color = parse_hex_color("#ff8000");
  EXPECT_EQ(color[0], 1);
  EXPECT_EQ(srgb_byte(color[1]), 128);
  EXPECT_EQ(color[2], 0);
  for (const char* bad : {"", "#", "ff8000", "#ff80", "#ff80zz", "#ff80000", "#+f8000"})
    EXPECT_THROW(parse_hex_color(bad), Error) << bad;
}

TEST(Ramp, UnknownNameIsHelped) {
  try {
    named_ramp("lepard");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    EXPECT_NE(std::string(error.what()).find("did you mean \"leopard\"?"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pelage
