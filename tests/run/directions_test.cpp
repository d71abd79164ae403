#include "run/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "catalog/bind.h"
#include "direction/direction_field.h"
#include "run/run.h"
#include "shape/generators.h"
#include "shape/normals.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using std::numbers::pi;

Point around_z(const Point& p) { return unit({-p[1], p[0], 0}); }

void paint(TriangleMesh& mesh, const std::function<Point(const Point&)>& vector) {
  Attribute a{direction_attribute, 3, Domain::vertex, {}};
  for (const Point& p : mesh.points) {
    const Point d = vector(p);
    a.values.insert(a.values.end(), d.begin(), d.end());
  }
  mesh.set(std::move(a));
}

Topology topology_of(const TriangleMesh& mesh) { return make_topology(mesh.points.size(), mesh.triangles); }

std::vector<Tensor> lines_of(const TriangleMesh& mesh) { return vertex_lines(mesh, {}, topology_of(mesh)); }

/// Sine of the angle between a line d d' and a unit vector.
double sine(const Tensor& t, const Point& d) {
  const double along = t[0] * d[0] * d[0] + t[3] * d[1] * d[1] + t[5] * d[2] * d[2] +
                       2 * (t[1] * d[0] * d[1] + t[2] * d[0] * d[2] + t[4] * d[1] * d[2]);
  return std::sqrt(std::max(0.0, 1 - along));
}

/// On a plane a field that is parallel where it is painted is parallel everywhere.
TEST(GivenDirections, AreContinuedParallelOnAPlane) {
  TriangleMesh mesh = builtin_shape("builtin:plane?n=400");
  const Point wish{std::cos(0.3), std::sin(0.3), 0};
  paint(mesh, [&](const Point& p) { return p[0] < 0.3 ? wish : Point{}; });
  for (const Tensor& t : lines_of(mesh)) EXPECT_LE(sine(t, wish), 1e-7);
}

/// Of a field around an axis on a band, the smoothest continuation turns around the axis, too: nothing tells one side
/// of a meridian from the other.
TEST(GivenDirections, AreContinuedAroundThePolesOfASphere) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  paint(mesh, [&](const Point& p) { return std::abs(p[2]) < 0.6 ? around_z(p) : Point{}; });
  const std::vector<Tensor> lines = lines_of(mesh);
  for (std::size_t v = 0; v < lines.size(); ++v) {
    const Point& p = mesh.points[v];
    if (std::abs(p[2]) < 0.6) {
      EXPECT_LE(sine(lines[v], around_z(p)), 1e-7);  // exactly as painted
    } else if (std::hypot(p[0], p[1]) > 0.2) {
      EXPECT_LE(sine(lines[v], around_z(p)), 0.03) << v;
    }
  }
}

/// Largest turn along an edge [degrees] outside of the balls about the places where the field has to be singular.
double largest_turn(const TriangleMesh& mesh, const std::vector<Tensor>& lines, std::size_t& singular) {
  const Connection c = make_connection(topology_of(mesh), mesh.points);
  std::vector<double> angle;
  for (Index v = 0; v < c.topology.vertex_count; ++v) {
    const Tensor& t = lines[static_cast<std::size_t>(v)];
    const auto in = [&](const Point& a, const Point& b) {
      return a[0] * (t[0] * b[0] + t[1] * b[1] + t[2] * b[2]) + a[1] * (t[1] * b[0] + t[3] * b[1] + t[4] * b[2]) +
             a[2] * (t[2] * b[0] + t[4] * b[1] + t[5] * b[2]);
    };
    const Point e = c.tangent(v, 0), n = c.tangent(v, pi / 2);
    angle.push_back(std::atan2(2 * in(e, n), in(e, e) - in(n, n)) / 2);
  }
  const std::vector<int> index = singularity_indices(c, 2, angle);
  std::vector<Point> centres;
  for (std::size_t f = 0; f < index.size(); ++f)
    if (index[f] != 0) centres.push_back(mesh.points[static_cast<std::size_t>(mesh.triangles[f][0])]);
  singular = centres.size();
  double largest = 0;
  for (Index h = 0; h < std::ssize(c.transport); ++h) {
    const auto from = static_cast<std::size_t>(c.topology.origin(h)),
               to = static_cast<std::size_t>(c.topology.target(h));
    if (std::ranges::any_of(centres, [&](const Point& s) { return length(difference(s, mesh.points[from])) < 0.4; }))
      continue;
    const double turn =
        std::remainder(2 * (angle[to] - angle[from] - c.transport[static_cast<std::size_t>(h)]), 2 * pi);
    largest = std::max(largest, std::abs(turn) / 2 * 180 / pi);
  }
  return largest;
}

/// A patch painted on a sphere: no seam at its edge, and no more singularities than the sphere asks for.
TEST(GivenDirections, EndWithoutASeam) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  paint(mesh, [&](const Point& p) { return p[0] > 0.3 ? around_z(p) : Point{}; });
  std::size_t singular = 0;
  const double turn = largest_turn(mesh, lines_of(mesh), singular);
  RecordProperty("turn", std::to_string(turn));
  EXPECT_EQ(singular, 4U);
  EXPECT_LE(turn, 15);
}

/// 0, not finite and along the normal are three ways to say nothing.
TEST(GivenDirections, SayNothingInThreeWays) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto painted = [&](const std::function<Point(const Point&)>& nothing) {
    paint(mesh, [&](const Point& p) { return p[0] > 0.3 ? around_z(p) : nothing(p); });
    return lines_of(mesh);
  };
  const std::vector<Tensor> lines = painted([](const Point&) { return Point{}; });
  for (const Tensor& t : lines) EXPECT_NEAR(t[0] + t[3] + t[5], 1, 1e-12);
  EXPECT_EQ(painted([&](const Point&) { return Point{nan, nan, nan}; }), lines);
  EXPECT_EQ(painted([&](const Point& p) { return Point{2 * p[0], 2 * p[1], 2 * p[2]}; }), lines);
}

/// Pieces of the shape without a wish have their own smoothest field.
TEST(GivenDirections, OfOnePieceLeaveTheOther) {
  TriangleMesh mesh = builtin_shape("builtin:plane?n=100");
  const auto count = static_cast<Index>(mesh.points.size());
  TriangleMesh two = mesh;
  for (const Point& p : mesh.points) two.points.push_back({p[0] + 3, p[1], p[2]});
  for (const Triangle& t : mesh.triangles) two.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  paint(two, [](const Point& p) { return p[0] < 0.5 ? Point{1, 0, 0} : Point{}; });
  const std::vector<Tensor> lines = lines_of(two);
  for (std::size_t v = 0; v < two.points.size(); ++v) {
    EXPECT_NEAR(lines[v][0] + lines[v][3] + lines[v][5], 1, 1e-9);
    if (two.points[v][0] < 2) {
      EXPECT_LE(sine(lines[v], {1, 0, 0}), 1e-7);
    }
  }
}

/// The run says what it follows, and warns of directions that say nothing.
TEST(GivenDirections, AreNamed) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  Recipe recipe;
  recipe.stages[0].model.value = "witkin-kass-stripes";
  const auto stage = [&] { return make_program(recipe, mesh).stages[0].follows; };
  EXPECT_EQ(stage(), "the smoothest field of lines");
  for (const char* end : {"_x", "_y", "_z"})
    mesh.set(
        {std::string("Direction") + end, 1, Domain::vertex, std::vector<double>(mesh.points.size(), end[1] == 'z')});
  EXPECT_EQ(
      stage(),
      "Direction_x, Direction_y, Direction_z of the shape; 2 of 642 vertices without a direction get the smoothest "
      "field between the others");
  paint(mesh, [](const Point& p) { return std::abs(p[2]) < 0.9 ? around_z(p) : Point{1, 0, 0}; });
  EXPECT_EQ(stage(), "direction of the shape; Direction_x, Direction_y, Direction_z of the shape: not followed");
  paint(mesh, [](const Point&) { return Point{}; });
  EXPECT_EQ(make_program(recipe, mesh).warnings.size(), 1U);
  mesh.attributes.resize(3);
  recipe.stages[0].directions.emplace().axis = Point{1, 0, 0};
  EXPECT_EQ(stage(), "the directions of the recipe; Direction_x, Direction_y, Direction_z of the shape: not followed");
  recipe.stages[0].model.value = "turing";
  recipe.stages[0].directions.reset();
  EXPECT_EQ(stage(), "");
}

}  // namespace
}  // namespace pelage
