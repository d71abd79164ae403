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

/// A look that says this of a channel, at a line of its own.
Paint with_channel(Channel channel, const std::string& formula) {
  Look look;
  look.channels[channel] = {formula, {"look.toml", 7, 3}};
  return resolve_paint(look, {"large.b", "b"});
}

std::vector<double> values_of(Channel channel, const std::string& formula, double wavelength = 1) {
  CoatSamples s = samples();
  s.wavelength = wavelength;
  return channel_values(s, with_channel(channel, formula), channel);
}

TEST(Channels, AreFormulasClampedToTheirRange) {
  EXPECT_EQ(values_of(Channel::roughness, "b"), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(values_of(Channel::metalness, "1 - large.b - x"), (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(values_of(Channel::emission, "4*b - 1"), (std::vector<double>{0, 1, 7}));
  EXPECT_EQ(values_of(Channel::opacity, "0.25"), std::vector<double>(3, 0.25));
}

TEST(Channels, LengthsAreInSizesOfThePattern) {
  EXPECT_EQ(values_of(Channel::height, "b - 1", 4), (std::vector<double>{-4, -2, 4}));
  EXPECT_EQ(values_of(Channel::thickness, "b - 1", 4), (std::vector<double>{0, 0, 4}));
  EXPECT_EQ(values_of(Channel::roughness, "b", 4), values_of(Channel::roughness, "b"));
}

TEST(Channels, SayWhatWasClamped) {
  EXPECT_TRUE(clamped_channels(samples(), with_channel(Channel::roughness, "b/2")).empty());
  EXPECT_TRUE(clamped_channels(samples(), with_channel(Channel::height, "-1000*b")).empty());
  EXPECT_EQ(clamped_channels(samples(), with_channel(Channel::roughness, "b")),
            std::vector<std::string>{"the roughness runs from 0 to 2; it was clamped to 0 to 1"});
  EXPECT_EQ(clamped_channels(samples(), with_channel(Channel::emission, "b - 1")),
            std::vector<std::string>{"the emission runs from -1 to 1; it was clamped to 0 and more"});
}

TEST(Channels, FaultsHaveAPlace) {
  const auto fault_of = [](const std::string& formula) {
    try {
      values_of(Channel::roughness, formula);
    } catch (const Error& error) {
      EXPECT_EQ(error.where().line, 7) << formula;
      return std::optional(error.fault());
    }
    return std::optional<Fault>{};
  };
  EXPECT_EQ(fault_of("c"), Fault::usage);
  EXPECT_EQ(fault_of("b +"), Fault::usage);
  EXPECT_EQ(fault_of("t"), Fault::usage);
  EXPECT_EQ(fault_of("attribute(age)"), Fault::usage);
  EXPECT_EQ(fault_of("1/b"), Fault::numerics);
}

/// Random fields ride along with a surface that has moved, as in layers.
TEST(Channels, ReadNoiseAsLayersDo) {
  const Paint p = with_channel(Channel::roughness, "0.5 + 0.1*noise(2, 7)");
  CoatSamples moved = samples();
  for (Point& q : moved.position) q[0] *= 3;
  EXPECT_NE(channel_values(moved, p, Channel::roughness), channel_values(samples(), p, Channel::roughness));
  moved.drawn_at = positions;
  EXPECT_EQ(channel_values(moved, p, Channel::roughness), channel_values(samples(), p, Channel::roughness));
}

}  // namespace
}  // namespace pelage
