#include "look/layers.h"

#include <gtest/gtest.h>

#include "look/ramp.h"
#include "pelage/error.h"

namespace pelage {
namespace {

const std::vector<Point> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
const std::vector<double> field = {0, 0.5, 2};

Places places() {
  Places p{.positions = positions};
  p.attributes["b"] = field;
  p.attributes["large.b"] = field;
  return p;
}

std::vector<double> painted(const std::vector<Layer>& layers) {
  std::vector<double> colors(9, 0.5);
  paint(layers, {"b", "large.b"}, places(), colors);
  return colors;
}

TEST(Layers, CoverByTheirOpacity) {
  Layer layer;
  layer.color = {"#ffffff", {}};
  layer.opacity = {"b", {}};  // beyond 1 counts as 1
  EXPECT_EQ(painted({layer}), (std::vector<double>{0.5, 0.5, 0.5, 0.75, 0.75, 0.75, 1, 1, 1}));
  layer.opacity = {"large.b - x", {}};  // below 0 counts as 0
  EXPECT_EQ(painted({layer}), std::vector<double>(9, 0.5));
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

}  // namespace
}  // namespace pelage
