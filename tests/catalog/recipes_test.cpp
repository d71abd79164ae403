#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "catalog/bind.h"
#include "discretise/anisotropy.h"
#include "discretise/quadrature.h"
#include "discretise/surface_space.h"
#include "look/dress.h"
#include "pelage/grow.h"
#include "run/directions.h"
#include "run/run.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

class EveryRecipe : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, EveryRecipe, ::testing::ValuesIn(recipe_names()), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST_P(EveryRecipe, RunsSmallAndIsDressed) {
  Recipe recipe = load_recipe(GetParam());
  EXPECT_EQ(recipe.name, GetParam());
  EXPECT_FALSE(recipe.summary.empty());
  const bool solid = recipe.stages[0].method.value == tets_method.name;
  if (!solid) {
    EXPECT_EQ(recipe.shape, recipe.name == "replication" ? "builtin:tile?n=256" : "builtin:animal");
  }
  for (Stage& stage : recipe.stages) {
    stage.size->value.value = std::max(stage.size->value.value, 0.08);
    stage.steps = 3;
  }
  pelage::Run run(make_program(recipe, builtin_shape("builtin:animal?n=1000")));
  while (!run.done()) run.advance(10);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  const TriangleMesh coat = dress(run.fields(), recipe.look);
  for (const double c : coat.find("color")->values) EXPECT_TRUE(c >= 0 && c <= 1) << c;
}

/// A connected set of vertices.
struct Spot {
  Point centre{};
  std::vector<Index> members;
  bool large = false;  ///< some of it is frozen
};

std::vector<Spot> spots(const Topology& topology, const std::vector<Point>& position, std::vector<char> in_spot,
                        const std::vector<char>& frozen) {
  std::vector<Spot> found;
  std::vector<Index> ring;
  for (Index first = 0; first < topology.vertex_count; ++first) {
    if (!std::exchange(in_spot[static_cast<std::size_t>(first)], 0)) continue;
    Spot& spot = found.emplace_back();
    spot.members = {first};
    for (std::size_t k = 0; k < spot.members.size(); ++k) {
      const auto member = static_cast<std::size_t>(spot.members[k]);
      spot.large |= frozen[member] != 0;
      for (std::size_t d = 0; d < 3; ++d) spot.centre[d] += position[member][d];
      topology.one_ring(spot.members[k], ring);
      for (const Index n : ring)
        if (std::exchange(in_spot[static_cast<std::size_t>(n)], 0)) spot.members.push_back(n);
    }
    for (double& c : spot.centre) c /= static_cast<double>(spot.members.size());
  }
  return found;
}

double distance_to_nearest(const Point& p, const std::vector<Point>& others) {
  double nearest = 1e9;
  for (const Point& q : others) nearest = std::min(nearest, length(difference(p, q)));
  return nearest;
}

constexpr double large_spacing = 0.7;

/// A cascade of spots on the unit sphere.
struct Cascade {
  std::vector<Point> large, small;        ///< centres; spots that have grown onto a large one are part of it
  std::vector<Point> outside, dark;       ///< vertices outside of the frozen regions, and those of them in spots
  std::vector<std::vector<Point>> discs;  ///< the frozen regions
  explicit Cascade(const std::string& name) {
    Recipe recipe = load_recipe(name);
    const double factor = large_spacing / recipe.stages[0].size->value.value;
    for (Stage& stage : recipe.stages) stage.size = {{stage.size->value.value * factor, Length::Unit::world}, {}};
    pelage::Run run(make_program(recipe, builtin_shape("builtin:sphere?n=10242")));
    while (!run.done()) run.advance(1000);
    const SparseMatrix& values = run.space().node_values();
    const Vector first = values * run.finished()[0].fields[1], b = values * run.coefficients()[1];
    const auto& position = run.system().sampling->position;
    std::vector<char> frozen, in_spot;
    for (std::size_t v = 0; v < position.size(); ++v) {
      const auto i = static_cast<Eigen::Index>(v);
      frozen.push_back(first[i] < 4);
      in_spot.push_back(frozen[v] || b[i] < 2.5);
      if (!frozen[v]) outside.push_back(position[v]);
      if (!frozen[v] && in_spot[v]) dark.push_back(position[v]);
    }
    for (const Spot& s : spots(run.world().topology(), position, in_spot, frozen))
      (s.large ? large : small).push_back(s.centre);
    for (const Spot& s : spots(run.world().topology(), position, frozen, frozen)) {
      discs.emplace_back();
      for (const Index v : s.members) discs.back().push_back(position[static_cast<std::size_t>(v)]);
    }
  }
};

TEST(Cascades, SmallSpotsOfTheCheetahKeepAwayFromTheLargeOnes) {
  const Cascade cheetah("cheetah");
  EXPECT_GT(cheetah.large.size(), 15);
  EXPECT_GT(cheetah.small.size(), cheetah.large.size());
  // With finer elements and shorter steps the nearest is at 0.498 spacings.
  for (const Point& p : cheetah.small) EXPECT_GE(distance_to_nearest(p, cheetah.large), 0.48 * large_spacing);
}

/// In how many of 24 directions from the middle of a disc on the unit sphere something dark lies within `reach` of it.
int dark_directions(const std::vector<Point>& disc, const std::vector<Point>& dark, double reach) {
  Point middle{};
  for (const Point& p : disc)
    for (std::size_t d = 0; d < 3; ++d) middle[d] += p[d];
  middle = unit(middle);
  const Point right = unit(cross(middle, std::abs(middle[0]) < 0.7 ? Point{1, 0, 0} : Point{0, 1, 0}));
  const Point up = cross(middle, right);
  std::set<int> found;
  for (const Point& p : dark)
    if (distance_to_nearest(p, disc) < reach)
      found.insert(static_cast<int>((std::atan2(dot(p, up), dot(p, right)) / std::numbers::pi + 1) * 11.999));
  return static_cast<int>(found.size());
}

/// Disc by disc: dark within half a spacing of the small spots in most directions.
TEST(Cascades, EveryLargeSpotOfTheLeopardIsRinged) {
  const Cascade leopard("leopard");
  EXPECT_GT(leopard.discs.size(), 15);
  const Recipe recipe = load_recipe("leopard");
  const double small_spacing = large_spacing * recipe.stages[1].size->value.value / recipe.stages[0].size->value.value;
  double sum = 0;
  for (const std::vector<Point>& disc : leopard.discs) {
    const int ringed = dark_directions(disc, leopard.dark, 0.5 * small_spacing);
    EXPECT_GE(ringed, 14) << "a disc of " << disc.size() << " vertices";
    sum += ringed;
  }
  RecordProperty("mean", std::to_string(sum / static_cast<double>(leopard.discs.size())));
  EXPECT_GT(sum / static_cast<double>(leopard.discs.size()), 20);
}

/// On the unit sphere, with stages so many times as large as on the animal.
pelage::Run grown_on_sphere(Recipe recipe, double factor) {
  for (Stage& stage : recipe.stages) stage.size = {{stage.size->value.value * factor, Length::Unit::world}, {}};
  recipe.quality = {"draft", {}};
  pelage::Run run(make_program(recipe, builtin_shape("builtin:sphere?n=2562")));
  while (!run.done()) run.advance(1000);
  return run;
}

/// Mean of cos^2 of the angle between the gradients of two fields at the nodes where `counts`, by the square of the
/// first.
double alignment(const Space& space, const Vector& u, const Vector& v, const std::vector<char>& counts) {
  const Vector uv = space.gradient_product(SampleRule::vertices, u, v);
  const Vector uu = space.gradient_product(SampleRule::vertices, u, u);
  const Vector vv = space.gradient_product(SampleRule::vertices, v, v);
  double sum = 0, all = 0;
  for (Eigen::Index i = 0; i < uv.size(); ++i) {
    if (!counts[static_cast<std::size_t>(i)] || !(vv[i] > 0)) continue;
    sum += uv[i] * uv[i] / vv[i];
    all += uu[i];
  }
  return sum / all;
}

Vector coordinate(const Space& space, std::size_t d) {
  Vector x(space.unknowns());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = space.control()[static_cast<std::size_t>(i)][d];
  return x;
}

/// Wide stripes around the axis x, and within each light one narrow stripes that run along it.
TEST(Cascades, NarrowStripesOfTheLionfishRunAlongTheWideOnes) {
  const pelage::Run run = grown_on_sphere(load_recipe("lionfish"), 8);
  const Space& space = run.space();
  const auto& wide = run.finished()[0].fields;  // r, s2, s1, g2, g1
  const Vector narrow = run.coefficients()[4] - run.coefficients()[3], x = coordinate(space, 0);
  std::vector<char> light, all(static_cast<std::size_t>(x.size()), 1);
  for (Eigen::Index i = 0; i < x.size(); ++i) light.push_back(wide[4][i] < wide[3][i] && std::abs(x[i]) < 0.9);
  EXPECT_GT(alignment(space, wide[4] - wide[3], x, all), 0.95);
  EXPECT_GT(alignment(space, narrow, x, light), 0.85);
  constexpr std::size_t slices = 150;
  std::vector<double> mean(slices, 0), count(slices, 0), dark(slices, 0);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto k = static_cast<std::size_t>((x[i] + 1) / 2 * (slices - 1));
    mean[k] += narrow[i];
    count[k] += 1;
    dark[k] += wide[4][i] >= wide[3][i];
  }
  int bands = 0, stripes = 0;
  for (std::size_t k = 8; k + 8 < slices; ++k) {
    if (count[k] == 0 || count[k - 1] == 0) continue;
    const bool is_light = 2 * dark[k] < count[k], was_light = 2 * dark[k - 1] < count[k - 1];
    bands += is_light && !was_light;
    stripes += is_light && was_light && mean[k] > 0 && mean[k - 1] <= 0;
  }
  EXPECT_GE(bands, 2);
  EXPECT_GE(stripes, 2 * (bands - 1)) << bands;  // those at the ends of the axis are not whole
}

/// Nothing but the initiators makes the stripes: the seed counts for nothing, and without them nothing happens.
TEST(ZebraTurk, StripesComeFromTheInitiators) {
  Recipe recipe = load_recipe("zebra-turk");
  recipe.stages[0].size->value.value = 0.07;
  recipe.quality = {"draft", {}};
  const TriangleMesh shape = builtin_shape("builtin:animal?n=3000");
  const auto grown = [&] {
    pelage::Run run(make_program(recipe, shape));
    while (!run.done()) run.advance(1000);
    return run;
  };
  const pelage::Run run = grown();
  recipe.stages[0].seed = 7;
  const pelage::Run other = grown();
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(run.coefficients()[i], other.coefficients()[i]);

  // Stripes lie across the legs.
  const Space& space = run.space();
  const Vector stripes = run.coefficients()[4] - run.coefficients()[3], y = coordinate(space, 1);
  std::vector<char> legs;
  for (const double height : y) legs.push_back(height > 0.15 && height < 0.4);
  EXPECT_GT(alignment(space, stripes, y, legs), 0.75);  // of random stripes 0.5
  EXPECT_FALSE(run.uniform());

  recipe.stages[0].initial.clear();
  EXPECT_TRUE(grown().uniform());
}

/// One system sets the directions of another: along the axis y where it is low, across where it is high.
TEST(Parquet, StripesLieAcrossEachOther) {
  Recipe recipe = load_recipe("parquet");
  recipe.stages[1].size->value.value = 0.05;
  const pelage::Run run = grown_on_sphere(recipe, 7);
  const Space& space = run.space();
  const auto& patches = run.finished()[0].fields;  // r, s2, s1, g2, g1
  const Vector y = coordinate(space, 1), stripes = run.coefficients()[1] - run.coefficients()[0];
  std::vector<char> high, low;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double difference = std::abs(y[i]) < 0.9 ? patches[4][i] - patches[3][i] : 0;
    high.push_back(difference > 0.4);
    low.push_back(difference < -0.4);
  }
  EXPECT_LT(alignment(space, stripes, y, low), 0.25);
  EXPECT_GT(alignment(space, stripes, y, high), 0.75);
}

/// One system makes the substrate of another uneven: there spots are of more kinds of sizes.
TEST(UnevenGround, SpotsAreRaggedWhereTheFirstSystemIsHigh) {
  const pelage::Run run = grown_on_sphere(load_recipe("uneven-ground"), 6.5);
  const auto& ground = run.finished()[0].fields;  // r, s2, s1, g2, g1
  const Vector b = run.coefficients()[1];
  std::vector<char> high, in_spot;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    high.push_back(ground[4][i] > ground[3][i]);
    in_spot.push_back(b[i] < 3);
  }
  // Per kind of ground: how many spots, the sum of their vertices, and that of the squares.
  std::array<std::array<double, 3>, 2> sums{};
  for (const Spot& s : spots(run.world().topology(), run.system().sampling->position, in_spot, high)) {
    const auto n = static_cast<double>(s.members.size());
    std::array<double, 3>& sum = sums[s.large];
    sum = {sum[0] + 1, sum[1] + n, sum[2] + n * n};
  }
  const auto variation = [](const std::array<double, 3>& sum) {
    const double mean = sum[1] / sum[0];
    return std::sqrt(sum[2] / sum[0] - mean * mean) / mean;
  };
  EXPECT_GT(sums[0][0], 20);
  EXPECT_GT(sums[1][0], 20);
  EXPECT_GT(variation(sums[1]), 1.5 * variation(sums[0])) << variation(sums[1]) << ' ' << variation(sums[0]);
}

/// Run to its end: patches apart from each other, with pale lines of about one width between them, that cover most.
TEST(Giraffe, PatchesAreApartAndFillTheSurface) {
  const pelage::Run run = grown_on_sphere(load_recipe("giraffe"), 4);
  const Vector difference = run.space().node_values() * (run.coefficients()[1] - run.coefficients()[0]);
  const auto& position = run.system().sampling->position;
  std::vector<char> on;
  for (const double d : difference) on.push_back(d > -0.06);
  double covered = 0;
  for (const char c : on) covered += c;
  EXPECT_GT(covered, 0.5 * static_cast<double>(on.size()));
  EXPECT_LT(covered, 0.85 * static_cast<double>(on.size()));
  const std::vector<Spot> patches = spots(run.world().topology(), position, on, on);
  EXPECT_GE(patches.size(), 20U);
  for (const Spot& s : patches) EXPECT_LT(static_cast<double>(s.members.size()), 0.25 * covered);
}

/// Mean angle in degrees between the stripes of a finished run and the field they follow, weighted with the squared
/// gradient.
double angle_to_field(const pelage::Run& run, const TriangleMesh& shape) {
  const auto& space = dynamic_cast<const SurfaceSpace&>(run.space());
  const std::vector<double> zero(static_cast<std::size_t>(space.discretisation().first_point.back()), 0);
  const std::vector<double> one(zero.size(), 1);
  const auto lines =
      run.world().at_nodes(vertex_lines(shape, run.stage_program().directions, run.world().hierarchy()->topology(0)));
  const std::vector<Tensor> line = space.tensors(lines, {zero, one, zero});
  const Vector difference = run.coefficients()[1] - run.coefficients()[0];
  double angle = 0, weight = 0;
  const std::vector<Point> gradients = quadrature_gradients(space.discretisation(), space.control(), difference);
  for (std::size_t q = 0; q < gradients.size(); ++q) {
    const auto& [x, y, z] = gradients[q];
    const auto& [xx, xy, xz, yy, yz, zz] = line[q];
    const double square = dot(gradients[q], gradients[q]);
    if (!(square > 0)) continue;
    const double along = xx * x * x + yy * y * y + zz * z * z + 2 * (xy * x * y + xz * x * z + yz * y * z);
    angle += square * std::asin(std::sqrt(std::clamp(along / square, 0.0, 1.0)));
    weight += square;
  }
  return angle / weight * 180 / std::numbers::pi;
}

TEST(Zebra, StripesFollowTheFieldOnTheAnimal) {
  Recipe recipe = load_recipe("zebra");
  recipe.stages[0].size->value.value = 0.1;
  const TriangleMesh shape = builtin_shape("builtin:animal?n=3000");
  pelage::Run run(make_program(recipe, shape));
  while (!run.done()) run.advance(1000);
  const double angle = angle_to_field(run, shape);
  RecordProperty("angle", std::to_string(angle));
  EXPECT_LE(angle, 10);
}

/// Heights of the spots on the unit sphere, of the same size everywhere or of 2 + z times that.
std::vector<double> heights_of_spots(double size, bool mapped) {
  Recipe recipe = parse_recipe(std::string("[stage]\nmodel = \"turing\"\n") + (mapped ? "size-map = \"2 + z\"\n" : ""),
                               "test.toml");
  recipe.stages[0].size = {{size, Length::Unit::world}, {}};
  pelage::Run run(make_program(recipe, builtin_shape("builtin:sphere?n=10242")));
  while (!run.done()) run.advance(1000);
  const Vector b = run.space().node_values() * run.coefficients()[1];
  const auto& position = run.system().sampling->position;
  std::vector<char> in_spot;
  for (const double value : b) in_spot.push_back(value < 3);
  std::vector<double> heights;
  for (const Spot& s : spots(run.world().topology(), position, in_spot, in_spot))
    heights.push_back(s.centre[2] / length(s.centre));
  return heights;
}

TEST(SizeMap, LocalSpacingFollowsTheMapFromOneToThree) {
  const double uniform_size = 0.4, size = 0.2;
  // Spots per area are constant / size^2.
  const double constant = static_cast<double>(heights_of_spots(uniform_size, false).size()) * uniform_size *
                          uniform_size / (4 * std::numbers::pi);
  const std::vector<double> heights = heights_of_spots(size, true);
  for (const auto& [low, high] : {std::pair{-1.0, -0.5}, std::pair{-0.5, 0.1}, std::pair{0.1, 1.0}}) {
    const auto found = std::ranges::count_if(heights, [a = low, b = high](double z) { return z >= a && z < b; });
    const double wanted =
        constant / (size * size) * 2 * std::numbers::pi * (1 / (2 + low) - 1 / (2 + high));  // of 1 / (2 + z)^2
    EXPECT_NEAR(std::sqrt(wanted / static_cast<double>(found)), 1, 0.15) << low << ": " << found << " of " << wanted;
  }
}

}  // namespace
}  // namespace pelage
