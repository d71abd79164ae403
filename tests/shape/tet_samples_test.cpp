#include "shape/tet_samples.h"

#include <gtest/gtest.h>

#include "shape/grid.h"
#include "shape/sample_volumes.h"

namespace pelage {
namespace {

/// Linear fields stay what they are inside, and are continued outside.
TEST(TetSamples, LinearFieldsComeBack) {
  TetMesh volume = test::cube_of_tets(5, 0.2);
  Attribute u{"u", 2, Domain::vertex, {}, NumberType::float64},
      group{"group", 1, Domain::vertex, {}, NumberType::int32, {"a", "b"}};
  const auto linear = [](const Point& p, std::size_t k) { return 2 * p[0] - p[1] + (k == 0 ? 0.25 : -1) * p[2]; };
  for (const Point& p : volume.points) {
    for (std::size_t k = 0; k < 2; ++k) u.values.push_back(linear(p, k));
    group.values.push_back(p[0] > 0.5 ? 1 : 0);
  }
  volume.set(u);
  volume.set(group);
  volume.metres_per_unit = 0.01;
  const Grid block = sampled(volume);
  require_sound(block);
  EXPECT_EQ(block.metres_per_unit, 0.01);
  EXPECT_NEAR(block.spacing[0], std::cbrt(1.0 / 216), 1e-12);  // a node has as much room as one of the volume
  const std::vector<double>& inside = block.find("inside")->values;
  double count = 0;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(block.nodes()); ++v) {
    const Point p = block.point(v);
    const bool in = std::ranges::all_of(p, [](double x) { return x > -1e-9 && x < 1 + 1e-9; });
    EXPECT_EQ(inside[static_cast<std::size_t>(v)], in ? 1 : 0);
    count += in ? 1 : 0;
    for (std::size_t k = 0; in && k < 2; ++k)
      EXPECT_NEAR(block.find("u")->values[2 * static_cast<std::size_t>(v) + k], linear(p, k), 1e-12);
    const double name = block.find("group")->values[static_cast<std::size_t>(v)];
    EXPECT_TRUE(name == 0 || name == 1);
  }
  EXPECT_GT(count, 100);
  EXPECT_EQ(block.find("group")->labels.size(), 2U);
}

/// A tetrahedron in its box: a sixth of the nodes lie in it, and those beside it go on with what is near.
TEST(TetSamples, OutsideIsFilledFromInside) {
  TetMesh volume = test::cube_of_tets(16);
  std::erase_if(volume.tets, [&](const Tetrahedron& t) {
    double sum = 0;
    for (const std::int32_t v : t)
      for (const double x : volume.points[static_cast<std::size_t>(v)]) sum += x / 4;
    return sum > 1;
  });
  Attribute one{"one", 1, Domain::vertex, std::vector<double>(volume.nodes(), 7), NumberType::float32};
  volume.set(one);
  const Grid block = sampled(volume);
  const std::vector<double>& inside = block.find("inside")->values;
  const double part = static_cast<double>(std::ranges::count(inside, 1)) / static_cast<double>(inside.size());
  EXPECT_NEAR(part, 1.0 / 6, 0.05);
  EXPECT_EQ(block.find("one")->values, std::vector<double>(block.nodes(), 7));
}

}  // namespace
}  // namespace pelage
