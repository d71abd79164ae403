#include "shape/stroke.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pelage/io.h"
#include "shape/normals.h"

namespace pelage {
namespace {

TEST(BrushStroke, FadesFromTheHardPartToTheEdge) {
  std::vector<Point> line;
  for (int i = 0; i <= 100; ++i) line.push_back({0.01 * i, 0, 0});
  const std::vector<Point> up(line.size(), {0, 0, 1});
  const std::vector<double> shares = stroke_shares({{{0, 0, 0}}, 0.8, 0.25}, line, up);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i][0] <= 0.2) {
      EXPECT_EQ(shares[i], 1) << i;
    }
    if (line[i][0] >= 0.8) {
      EXPECT_EQ(shares[i], 0) << i;
    }
    if (i > 0) {
      EXPECT_LE(shares[i], shares[i - 1]);
    }
  }
  EXPECT_NEAR(shares[50], 0.5, 1e-12);  // half way
}

TEST(BrushStroke, IsAsWideAlongASegmentAsAtItsEnds) {
  const std::vector<Point> places = {{0.5, 0.1, 0}, {0, 0.1, 0}, {-0.1, 0, 0}, {1.05, 0.05, 0}, {0.5, 0.3, 0}};
  const std::vector<double> shares = stroke_shares({{{0, 0, 0}, {1, 0, 0}}, 0.2, 0}, places, {});
  EXPECT_NEAR(shares[0], 0.5, 1e-12);
  EXPECT_NEAR(shares[1], shares[0], 1e-12);
  EXPECT_NEAR(shares[2], shares[0], 1e-12);
  EXPECT_GT(shares[3], shares[0]);
  EXPECT_EQ(shares[4], 0);
}

// A leaf thinner than the brush: its other side stays as it is.
TEST(BrushStroke, DoesNotComeThrough) {
  std::vector<Point> places, normals;
  for (const double z : {0.0, -0.01})
    for (int i = -5; i <= 5; ++i) {
      places.push_back({0.1 * i, 0, z});
      normals.push_back({0, 0, z < 0 ? -1.0 : 1.0});
    }
  const std::vector<double> shares = stroke_shares({{{0, 0, 0.002}}, 0.35, 1}, places, normals);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_EQ(shares[i], normals[i][2] > 0 && std::abs(places[i][0]) < 0.35 ? 1 : 0) << i;
}

}  // namespace
}  // namespace pelage
