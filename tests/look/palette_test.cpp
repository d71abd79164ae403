#include "look/palette.h"

#include <gtest/gtest.h>

#include "look/ramp.h"
#include "pelage/error.h"

namespace pelage {
namespace {

const std::vector<Point> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
const std::vector<double> field = {0, 0.5, 2};

/// The field "b" as that of a stage called large, and by itself.
CoatSamples samples() {
  CoatSamples s;
  s.position = positions;
  s.fields = {field, field};
  return s;
}

/// Over mid grey, the colour of a ramp that has no other.
std::vector<double> painted(const std::vector<Layer>& layers) {
  Look look;
  look.layers = layers;
  Layer grey;
  grey.color = {"#bcbcbc", {}};
  look.layers.insert(look.layers.begin(), grey);
  const Paint p = resolve_paint(look, {"large.b", "b"});
  return paint(samples(), make_palette(p, samples(), {0, 0}));
}

const double ground = parse_hex_color("#bcbcbc")[0];

TEST(Layers, CoverByTheirOpacity) {
  Layer layer;
  layer.color = {"#ffffff", {}};
  layer.opacity = {"b", {}};  // beyond 1 counts as 1
  const double half = ground + 0.5 * (1 - ground);
  EXPECT_EQ(painted({layer}), (std::vector<double>{ground, ground, ground, half, half, half, 1, 1, 1}));
  layer.opacity = {"large.b - x", {}};  // below 0 counts as 0
  EXPECT_EQ(painted({layer}), std::vector<double>(9, ground));
  layer.opacity.reset();
  EXPECT_EQ(painted({layer}), std::vector<double>(9, 1));
}

TEST(Layers, TheLastOneIsOnTop) {
  Layer white, black;
  white.color = {"#ffffff", {}};
  black.color = {"#000000", {}};
  EXPECT_EQ(painted({white, black}), std::vector<double>(9, 0));
  EXPECT_EQ(painted({black, white}), std::vector<double>(9, 1));
}

TEST(Layers, RampsRunFromLowToHigh) {
  Layer layer;
  layer.ramp = {"zebra", {}};
  layer.value = {"b", {}};
  layer.high = 2;
  const std::vector<double> colors = painted({layer});
  for (std::size_t i = 0; i < 3; ++i) {
    const Color expected = named_ramp("zebra")(field[i] / 2);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(colors[3 * i + c], expected[c], 1e-15);
  }
}

TEST(Layers, FaultsHaveAPlace) {
  const auto fails_at = [](const Layer& layer) {
    try {
      painted({layer});
    } catch (const Error& error) {
      return error.where().line;
    }
    return 0;
  };
  const Location here{"look.toml", 7, 3};
  Layer layer;
  layer.color = {"red", here};
  EXPECT_EQ(fails_at(layer), 7);
  layer.color = {"#ff0000", {}};
  layer.opacity = {"c + 1", here};
  EXPECT_EQ(fails_at(layer), 7);
  layer.opacity = {"large.c", here};
  EXPECT_EQ(fails_at(layer), 7);
  layer = {};
  layer.ramp = {"zebre", here};
  EXPECT_EQ(fails_at(layer), 7);
}

TEST(Palette, RunsBetweenTheExtremesUnlessThereIsNoPattern) {
  const auto colors = [](const char* ramp, bool invert, char uniform) {
    Look look;
    look.ramp.value = ramp;
    look.invert = invert;
    return paint(samples(), make_palette(resolve_paint(look, {"large.b", "b"}), samples(), {0, uniform}));
  };
  const auto color = [](const std::vector<double>& all, std::size_t i) {
    return Color{all[3 * i], all[3 * i + 1], all[3 * i + 2]};
  };
  const Ramp ramp = named_ramp("reef");
  const std::vector<double> plain = colors("reef", false, 0), inverted = colors("reef", true, 0),
                            uniform = colors("reef", false, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(color(plain, i), ramp(field[i] / 2));
    EXPECT_EQ(color(inverted, i), ramp(1 - field[i] / 2));
    EXPECT_EQ(color(uniform, i), ramp(0.5));
  }
}

TEST(Palette, UnknownSpeciesAreFaultsWithAPlace) {
  Look look;
  look.species = {"c", {"look.toml", 3, 1}};
  try {
    resolve_paint(look, {"large.b", "b"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where().line, 3);
    EXPECT_NE(std::string(error.what()).find("unknown species \"c\""), std::string::npos);
  }
}

/// Lengths of noise are those of the model, as in a stage, and the seed counts.
TEST(Layers, NoiseHasTheUnitAndTheSeedOfTheStage) {
  Layer layer;
  layer.color = {"#ffffff", {}};
  layer.opacity = {"0.5 + 0.1*noise(2, 7)", {}};
  Look look;
  look.layers = {layer};
  const Paint p = resolve_paint(look, {"b"});
  const auto with = [&](double unit, std::uint64_t seed) {
    CoatSamples s = samples();
    s.fields = {field};
    s.length_unit = unit;
    s.seed = seed;
    for (Point& q : s.position)
      for (double& x : q) x *= unit;
    return paint(s, make_palette(p, s, {1}));
  };
  const std::vector<double> one = with(1, 1);
  EXPECT_EQ(one, with(4, 1));
  EXPECT_NE(one, with(1, 2));
}

}  // namespace
}  // namespace pelage
