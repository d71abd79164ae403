#include "run/space_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discretise/grid_space.h"
#include "discretise/tet_space.h"
#include "pelage/error.h"
#include "run/directions.h"
#include "shape/generators.h"
#include "shape/grid.h"
#include "shape/tet_mesh.h"
#include "shape/vectors.h"
#include "solid/fill.h"

namespace pelage {
namespace {

const TetMesh& ball() {
  static const TetMesh made = fill(builtin_shape("builtin:sphere?n=500"), 0.25, 1'000'000).volume;
  return made;
}

/// T at the quadrature points with the rates 2 and 1, each with the middle of its tetrahedron.
std::vector<std::pair<Point, Eigen::Matrix3d>> tensors(const TetMesh& volume, const std::optional<FieldWish>& wish) {
  const TetSpace space(volume);
  const std::vector<Tensor> lines = node_lines(volume, space, mesh_of(volume), wish);
  const std::size_t n = 4 * volume.tets.size();
  const std::vector<Tensor> at_points =
      space.tensors(lines, {std::vector<double>(n, 0.0), std::vector<double>(n, 2.0), std::vector<double>(n, 1.0)});
  std::vector<std::pair<Point, Eigen::Matrix3d>> result;
  for (std::size_t t = 0; t < volume.tets.size(); ++t) {
    Point middle{};
    for (const std::int32_t v : volume.tets[t])
      for (std::size_t d = 0; d < 3; ++d) middle[d] += volume.points[static_cast<std::size_t>(v)][d] / 4;
    result.push_back({middle, matrix_of(at_points[4 * t])});
  }
  return result;
}

Eigen::Matrix3d projector(const Point& along) { return matrix_of(line_tensor(unit(along))); }
const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();

/// On surfaces the first rate holds along the field, and with `across` along what is across it; in space that is a
/// plane.
TEST(SpaceLines, AcrossALineIsThePlaneNormalToIt) {
  FieldWish wish;
  wish.axis = {0, 0, 3};
  const Eigen::Matrix3d p = projector({0, 0, 1});
  for (const auto& [place, t] : tensors(ball(), wish)) EXPECT_LT((t - (4 * p + (one - p))).norm(), 1e-12);
  wish.across = true;
  for (const auto& [place, t] : tensors(ball(), wish)) EXPECT_LT((t - (p + 4 * (one - p))).norm(), 1e-12);
  wish.axis.reset();
  wish.centre = {3, 0, 0};
  for (const auto& [place, t] : tensors(ball(), wish)) {
    const Eigen::Matrix3d away = projector(difference(place, *wish.centre));
    EXPECT_LT((t - (away + 4 * (one - away))).norm(), 0.2);
  }
}

/// A block has one tensor for all nodes.
TEST(SpaceLines, BlocksHavePlanesToo) {
  Grid block;
  block.count = {5, 5, 5};
  block.spacing = {1, 1, 1};
  FieldWish wish;
  wish.axis = {1, 1, 0};
  wish.across = true;
  const std::vector<Tensor> lines = node_lines(block, GridSpace(block), mesh_of(block), wish);
  ASSERT_EQ(lines.size(), 1U);
  const Eigen::Matrix3d p = projector({1, 1, 0});
  EXPECT_LT((matrix_of(volume_tensor(lines[0], 2, 1)) - (p + 4 * (one - p))).norm(), 1e-12);
}

/// Inside of a volume there are no normals that a vector of the shape could lie along.
TEST(SpaceLines, VectorsOfTheShapeAreFollowedInside) {
  TetMesh volume = ball();
  const auto with = [&](auto&& vector) {
    Attribute a{direction_attribute, 3, Domain::vertex, {}};
    for (const Point& p : volume.points) {
      const Point d = vector(p);
      a.values.insert(a.values.end(), d.begin(), d.end());
    }
    volume.set(std::move(a));
  };
  const Point d{0.3, -0.5, 0.8};
  const Eigen::Matrix3d expected = one + 3 * projector(d);
  with([&](const Point&) { return d; });
  for (const auto& [place, t] : tensors(volume, {})) EXPECT_LT((t - expected).norm(), 1e-12);
  // Where they say nothing, the others' are continued: the same between the same.
  with([&](const Point& p) { return length(p) > 0.6 ? d : Point{}; });
  for (const auto& [place, t] : tensors(volume, {})) EXPECT_LT((t - expected).norm(), 1e-6);
  with([&](const Point&) { return Point{}; });
  for (const auto& [place, t] : tensors(volume, {})) EXPECT_LT((t - (one + 3 * projector({1, 0, 0}))).norm(), 1e-12);
}

/// Between the ends of a bar the harmonic function rises evenly.
TEST(SpaceLines, WaysLeadFromMarksToMarks) {
  TriangleMesh bar = builtin_shape("builtin:sphere?n=500");
  for (Point& p : bar.points) p = {2 * std::clamp(p[0], -0.5, 0.5), p[1], p[2]};
  const TetMesh volume = fill(bar, 0.2, 1'000'000).volume;
  FieldWish wish;
  for (std::size_t v = 0; v < volume.nodes(); ++v) {
    if (volume.points[v][0] < -0.9) wish.from.push_back(static_cast<Index>(v));
    if (volume.points[v][0] > 0.9) wish.to.push_back(static_cast<Index>(v));
  }
  double mean = 0, count = 0;
  for (const auto& [place, t] : tensors(volume, wish)) {
    mean += (t - one)(0, 0) / 3;
    ++count;
  }
  EXPECT_GT(mean / count, 0.97);
  wish.to.clear();
  EXPECT_THROW(tensors(volume, wish), Error);
}

/// Near a stroke its own line, between two the nearer one's, far away the axis.
TEST(SpaceLines, StrokesCountByTheirNearness) {
  FieldWish wish;
  wish.strokes = {{{-1, -0.7, 0}, {1, -0.7, 0}}, {{0, 0.7, -1}, {0, 0.7, 1}}};
  wish.smooth = 0.1;
  for (const auto& [place, t] : tensors(ball(), wish)) {
    if (place[1] < -0.5) {
      EXPECT_GT((t - one)(0, 0), 2.9);
    }
    if (place[1] > 0.5) {
      EXPECT_GT((t - one)(2, 2), 2.9);
    }
    EXPECT_LT((t - one)(1, 1), 1e-9);
  }
  wish.axis = {0, 1, 0};
  wish.smooth = 0.3;
  for (const auto& [place, t] : tensors(ball(), wish)) {
    if (std::hypot(place[1] + 0.7, place[2]) < 0.05) {
      EXPECT_GT((t - one)(0, 0), 2.9);
    }
    if (std::abs(place[1]) < 0.2) {
      EXPECT_GT((t - one)(1, 1), 2.9);
    }
  }
}

TEST(SpaceLines, RefusesWhatOnlySurfacesHave) {
  FieldWish wish;
  wish.curvature = true;
  EXPECT_THROW(tensors(ball(), wish), Error);
  wish.curvature = false;
  wish.strokes = {{{0, 0, 0}, {1, 0, 0}}};
  EXPECT_NO_THROW(tensors(ball(), wish));
  wish.across = true;
  EXPECT_THROW(tensors(ball(), wish), Error);
  wish = {};
  wish.strokes = {{{1, 0, 0}, {1, 0, 0}}};
  EXPECT_THROW(tensors(ball(), wish), Error);
}

}  // namespace
}  // namespace pelage
