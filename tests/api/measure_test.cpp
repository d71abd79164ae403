#include <pelage/io.h>
#include <pelage/measure.h>

#include <cmath>
#include <numbers>

#include "api_support.h"

namespace pelage::api {
namespace {

/// A wave along x on the tile [0, 1]^2, four times.
ShapeFile waves() {
  ShapeFile shape = read_shape("builtin:plane?n=10000");
  Attribute u{"u", 1, Domain::vertex, {}};
  double low = 1e9, high = -1e9;
  for (const Point& p : shape.mesh.points) low = std::min(low, p[0]), high = std::max(high, p[0]);
  for (const Point& p : shape.mesh.points)
    u.values.push_back(std::sin(8 * std::numbers::pi * (p[0] - low) / (high - low)));
  shape.mesh.set(u);
  return shape;
}

TEST(Measure, OfAPlaneWave) {
  const ShapeFile shape = waves();
  double low = 1e9, high = -1e9;
  for (const Point& p : shape.mesh.points) low = std::min(low, p[0]), high = std::max(high, p[0]);
  const PatternMeasures m = measure(shape, "u");
  EXPECT_NEAR(m.wavelength, (high - low) / 4, 0.01 * (high - low) / 4);
  EXPECT_NEAR(m.above.share, 0.5, 0.01);
  EXPECT_GT(m.coherence, 0.95);
  EXPECT_LT(m.along[0], 0.05);
}

TEST(Measure, NamesWhatIsNotThere) {
  EXPECT_EQ(fault_of([] { measure(waves(), "v"); }), static_cast<int>(Fault::usage));
  EXPECT_EQ(fault_of([] { measure(read_shape("builtin:sphere?n=162")); }), static_cast<int>(Fault::input));
  EXPECT_EQ(field_names(waves().mesh), std::vector<std::string>{"u"});
}

}  // namespace
}  // namespace pelage::api
