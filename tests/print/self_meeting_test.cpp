#include "print/self_meeting.h"

#include <gtest/gtest.h>

#include "shape/generators.h"

namespace pelage {
namespace {

constexpr Triangle first{0, 1, 2}, second{3, 4, 5};

/// Of a triangle with corners in 0, x and y, and another.
bool meets(const Point& a, const Point& b, const Point& c) {
  return meet(first, second, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, a, b, c});
}

TEST(SelfMeeting, OfTrianglesWithoutCommonCorners) {
  EXPECT_TRUE(meets({0.2, 0.2, -1}, {0.2, 0.2, 1}, {3, 3, 0.5}));      // an edge through the inside
  EXPECT_TRUE(meets({-1, 0.3, -0.1}, {3, 0.3, -0.1}, {0.3, 0.3, 9}));  // around it
  EXPECT_FALSE(meets({0.6, 0.6, -1}, {0.6, 0.6, 1}, {3, 3, 0.5}));     // beside it
  EXPECT_FALSE(meets({0.2, 0.2, 1e-300}, {0.2, 0.2, 1}, {3, 3, 0.5}));
  EXPECT_TRUE(meets({0.2, 0.2, 0}, {0.2, 0.2, 1}, {3, 3, 0.5}));      // touches with a corner
  EXPECT_TRUE(meets({0, 0, 0}, {-1, 0, 1}, {-1, 0, 2}));              // corner in corner
  EXPECT_TRUE(meets({0.5, -1, 0}, {0.5, 1, 0}, {0.5, 0, 1}));         // an edge in the plane
  EXPECT_TRUE(meets({0.1, 0.1, 0}, {0.2, 0.1, 0}, {0.1, 0.2, 0}));    // inside, flat
  EXPECT_TRUE(meets({-9, -9, 0}, {9, -9, 0}, {0, 9, 0}));             // outside around, flat
  EXPECT_FALSE(meets({0.6, 0.6, 0}, {2, 0.6, 0}, {0.6, 2, 0}));       // beside, flat
  EXPECT_FALSE(meets({0.3, 0.3, -1}, {0.3, 0.3, 1}, {0.3, 0.3, 0}));  // without an area
}

TEST(SelfMeeting, OfNeighbours) {
  const auto fan = [](const Point& p, const Point& q) {
    return meet({0, 1, 2}, {0, 3, 4}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, p, q});
  };
  EXPECT_FALSE(fan({-1, 0, 0}, {0, -1, 0}));
  EXPECT_FALSE(fan({-1, 0, 1}, {0, -1, -1}));
  EXPECT_TRUE(fan({1, 1, 1}, {0.2, 0.2, -1}));
  EXPECT_TRUE(fan({1, 1, 0}, {2, 0, 0}));  // overlap in the plane
  const auto hinge = [](const Point& q) { return meet({0, 1, 2}, {1, 0, 3}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, q}); };
  EXPECT_FALSE(hinge({0, -1, 0}));
  EXPECT_FALSE(hinge({0, 1, 1e-200}));
  EXPECT_TRUE(hinge({1, 1, 0}));  // folded over
}

TEST(SelfMeeting, BallsThatOverlapMeetAlongACircle) {
  const TriangleMesh ball = builtin_shape("builtin:sphere?n=642");
  EXPECT_TRUE(self_meetings(ball.triangles, ball.points).empty());
  TriangleMesh two = ball;
  const auto n = static_cast<std::int32_t>(ball.points.size());
  for (const Point& p : ball.points) two.points.push_back({p[0] + 1, p[1] + 1e-3, p[2] + 2e-3});
  for (const Triangle& t : ball.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  const std::vector<Meeting> found = self_meetings(two.triangles, two.points);
  std::vector<Meeting> all;
  for (std::int32_t a = 0; a < 2 * n - 4; ++a)
    for (std::int32_t b = 2 * n - 4; b < 4 * n - 8; ++b)
      if (meet(two.triangles[a], two.triangles[b], two.points)) all.push_back({a, b});
  EXPECT_EQ(found, all);
  EXPECT_GT(found.size(), 60U);
  for (const Meeting& m : found) EXPECT_NEAR(middle_of(two.triangles[m.first], two.points)[0], 0.5, 0.15);
}

/// A closed surface in a plane's net: coplanar neighbours everywhere.
TEST(SelfMeeting, FlatFacesMeetNothing) {
  const TriangleMesh cube = builtin_shape("builtin:cube?n=600");
  EXPECT_TRUE(self_meetings(cube.triangles, cube.points).empty());
}

}  // namespace
}  // namespace pelage
