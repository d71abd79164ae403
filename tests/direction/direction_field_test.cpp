#include "direction/direction_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <numeric>

#include "direction/guides.h"
#include "direction/hatching.h"
#include "discretise/curvature.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "shape/describe.h"
#include "shape/generators.h"
#include "shape/refine.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

constexpr double degree = std::numbers::pi / 180;

Connection connection_of(const TriangleMesh& mesh) {
  return make_connection(make_topology(mesh.points.size(), mesh.triangles), mesh.points);
}

int index_sum(const DirectionField& f) { return std::accumulate(f.index.begin(), f.index.end(), 0); }

/// Of two lines [degrees].
double line_angle(const Point& a, const Point& b) {
  return std::acos(std::min(1.0, std::abs(dot(unit(a), unit(b))))) / degree;
}

Point tangential(const Connection& c, std::size_t v, const Point& d) {
  const double out = dot(c.normal[v], d);
  return {d[0] - out * c.normal[v][0], d[1] - out * c.normal[v][1], d[2] - out * c.normal[v][2]};
}

TEST(Connection, CurvatureAddsUpToTheEulerCharacteristic) {
  for (const char* name : {"builtin:sphere?n=642", "builtin:torus?n=500", "builtin:animal?n=1500"}) {
    const TriangleMesh mesh = builtin_shape(name);
    const Connection c = connection_of(mesh);
    double sum = 0;
    for (Index f = 0; f < std::ssize(mesh.triangles); ++f) sum += c.curvature(f);
    EXPECT_NEAR(sum / (2 * std::numbers::pi), static_cast<double>(describe(mesh, {}).euler_characteristic), 1e-9)
        << name;
  }
}

TEST(DirectionField, IndicesAddUpOnBuiltInShapes) {
  for (const char* name : {"builtin:sphere?n=642", "builtin:torus?n=500", "builtin:animal?n=1500"})
    for (const int n : {1, 2, 4}) {
      const TriangleMesh mesh = builtin_shape(name);
      EXPECT_EQ(index_sum(direction_field(connection_of(mesh), n)), n * describe(mesh, {}).euler_characteristic)
          << name << " " << n;
    }
}

/// Nothing for a file that cannot be made a manifold.
TriangleMesh manifold(const std::filesystem::path& path) {
  try {
    return read_shape(path).mesh;
  } catch (const Error&) {
    return {};
  }
}

// The larger ones of the folder hold as well, but take half a minute.
constexpr std::size_t most_triangles = 12000;

TEST(DirectionField, IndicesAddUpOnEveryClosedMesh) {
  if (!std::filesystem::exists(PELAGE_SHARED_MESHES)) GTEST_SKIP() << "no shared/meshes beside the checkout";
  int closed = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PELAGE_SHARED_MESHES)) {
    const std::string extension = entry.path().extension();
    if (extension != ".obj" && extension != ".off" && extension != ".ply" && extension != ".stl") continue;
    const TriangleMesh mesh = manifold(entry.path());
    if (mesh.points.empty() || mesh.triangles.size() > most_triangles) continue;
    const MeshReport report = describe(mesh, {});
    const DirectionField field = direction_field(connection_of(mesh), 2);
    for (const Point& d : field.direction) ASSERT_NEAR(length(d), 1, 1e-9) << entry.path();
    if (!report.closed) continue;
    EXPECT_EQ(index_sum(field), 2 * report.euler_characteristic) << entry.path();
    ++closed;
  }
  EXPECT_GE(closed, 10);
}

TEST(DirectionField, HasNoSingularityWhereNoneIsNeeded) {
  for (const char* name : {"builtin:torus?n=2000", "builtin:plane?n=400"}) {
    const DirectionField field = direction_field(connection_of(builtin_shape(name)), 2);
    for (const int index : field.index) EXPECT_EQ(index, 0) << name;
  }
}

TEST(DirectionField, SphereHasTheEigenvalueOfTheMonopole) {
  // The smallest eigenvalue of the connection Laplacian on the bundle of degree 2 n over the unit sphere is n.
  for (const int n : {1, 2}) {
    const DirectionField field = direction_field(connection_of(builtin_shape("builtin:sphere?n=4000")), n);
    EXPECT_NEAR(field.roughness, n, 0.02 * n);
  }
}

TEST(DirectionField, IsParallelOnAPlane) {
  const TriangleMesh mesh = builtin_shape("builtin:plane?n=400");
  const Connection c = connection_of(mesh);
  const Point wish{std::cos(0.3), std::sin(0.3), 0};
  const DirectionField field = direction_field(c, 1, {{17, wish, std::numeric_limits<double>::infinity()}});
  for (const Point& d : field.direction) EXPECT_NEAR(dot(d, wish), 1, 1e-9);
}

TEST(DirectionField, EveryPieceHasAField) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  const auto count = static_cast<Index>(mesh.points.size());
  TriangleMesh two = mesh;
  for (const Point& p : mesh.points) two.points.push_back({p[0] + 3, p[1], p[2]});
  for (const Triangle& t : mesh.triangles) two.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  const Connection c = connection_of(two);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const DirectionField& field : {direction_field(c, 2), direction_field(c, 2, {{5, {1, 2, 3}, infinity}})}) {
    const auto middle = field.index.begin() + static_cast<std::ptrdiff_t>(mesh.triangles.size());
    EXPECT_EQ(std::accumulate(field.index.begin(), middle, 0), 4);
    EXPECT_EQ(std::accumulate(middle, field.index.end(), 0), 4);
    int singular = 0;
    for (const int index : field.index) singular += index != 0;
    EXPECT_LE(singular, 8);  // no second field of noise
  }
}

TEST(DirectionField, RefusesWhatItDoesNotKnow) {
  const Connection c = connection_of(builtin_shape("builtin:sphere?n=642"));
  EXPECT_THROW(direction_field(c, 3), Error);
  EXPECT_THROW(direction_field(c, 2, {{642, {1, 0, 0}, 1}}), Error);
}

/// Largest angle in degrees between a stroke and the field at the vertices nearest to it.
double angle_to_stroke(const TriangleMesh& mesh, const std::vector<Point>& stroke) {
  const Connection c = connection_of(mesh);
  const std::vector<Guide> guides = stroke_guides(c, mesh.points, prevailing_edge(mesh.triangles, mesh.points), stroke);
  EXPECT_GT(guides.size(), 20U);
  double largest = 0;
  for (const int n : {1, 2, 4}) {
    const DirectionField field = direction_field(c, n, guides);
    EXPECT_EQ(index_sum(field), 2 * n);
    for (const Guide& g : guides) {
      const auto v = static_cast<std::size_t>(g.vertex);
      const Point wish = tangential(c, v, g.direction);
      const double angle = line_angle(field.direction[v], wish);
      largest = std::max(largest, n == 4 ? std::min(angle, 90 - angle) : angle);
    }
  }
  return largest;
}

TEST(Guides, StrokesAreFollowed) {
  std::vector<Point> climbing, flank;  // longitude t, latitude t / 2; a straight line along the side of the animal
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.05 * i;
    climbing.push_back({std::cos(t / 2) * std::cos(t), std::cos(t / 2) * std::sin(t), std::sin(t / 2)});
    flank.push_back({0.6 * (t - 1), 0.75, 0.35});
  }
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  EXPECT_LE(angle_to_stroke(mesh, climbing), 5);
  EXPECT_LE(angle_to_stroke(builtin_shape("builtin:animal?n=4000"), flank), 5);
  const Connection c = connection_of(mesh);
  EXPECT_THROW(stroke_guides(c, mesh.points, 0.1, {{1, 0, 0}}), Error);
}

TEST(Guides, AnAxisGivesMeridians) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  const Connection c = connection_of(mesh);
  const Point axis{0, 0, 1};
  const DirectionField along = direction_field(c, 2, axis_guides(c, axis, 100, Sense::along));
  const DirectionField across = direction_field(c, 2, axis_guides(c, axis, 100, Sense::across));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (std::abs(mesh.points[v][2]) > 0.7) continue;
    EXPECT_LE(line_angle(along.direction[v], tangential(c, v, axis)), 2);
    EXPECT_LE(line_angle(across.direction[v], cross(c.normal[v], axis)), 2);
  }
  EXPECT_THROW(axis_guides(c, {0, 0, 0}, 1, Sense::along), Error);
}

/// Seen from above, they run away from the centre; where the surface is perpendicular to that, they are free.
TEST(Guides, ACentreGivesRays) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  const Connection c = connection_of(mesh);
  const Point centre{0, 0, 1};
  const DirectionField along = direction_field(c, 2, centre_guides(c, mesh.points, centre, 100, Sense::along));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (std::abs(mesh.points[v][2]) > 0.7) continue;
    EXPECT_LE(line_angle(along.direction[v], tangential(c, v, difference(mesh.points[v], centre))), 2);
  }
}

TEST(Guides, CurvatureOfATorusRunsAroundItsTube) {
  const TriangleMesh mesh = builtin_shape("builtin:torus?n=2000");
  const Connection c = connection_of(mesh);
  const Discretisation d = loop_discretisation(c.topology);
  const DirectionField field =
      direction_field(c, 2, curvature_guides(c, vertex_curvature(d, mesh.points), 1, Sense::across));
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    EXPECT_LE(line_angle(field.direction[v], {-mesh.points[v][1], mesh.points[v][0], 0}), 3);
}

TEST(Guides, HarmonicFunctionRunsFromEndToEnd) {
  const TriangleMesh mesh = builtin_shape("builtin:plane?n=900");
  const Connection c = connection_of(mesh);
  std::vector<Index> low, high;
  for (Index v = 0; v < std::ssize(mesh.points); ++v) {
    if (mesh.points[static_cast<std::size_t>(v)][0] == 0) low.push_back(v);
    if (mesh.points[static_cast<std::size_t>(v)][0] == 1) high.push_back(v);
  }
  const std::vector<double> f = harmonic_function(c, low, high);
  for (std::size_t v = 0; v < f.size(); ++v) EXPECT_NEAR(f[v], mesh.points[v][0], 1e-8);
  for (const Guide& g : gradient_guides(c, vertex_gradients(c.topology, mesh.points, f), 1, Sense::along)) {
    EXPECT_LE(line_angle(g.direction, {1, 0, 0}), 1e-3);
    EXPECT_GT(g.direction[0], 0);
  }
  EXPECT_THROW(harmonic_function(c, {1}, {}), Error);
  EXPECT_THROW(harmonic_function(c, {1}, {1}), Error);
}

TEST(Guides, StrokesThatLeaveTheShapeFarBehindAreRefused) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  const Connection c = connection_of(mesh);
  for (const double far : {1e8, 1e300})
    EXPECT_THROW(stroke_guides(c, mesh.points, 0.1, {{1, 0, 0}, {far, 0, 0}}), Error) << far;
  EXPECT_FALSE(stroke_guides(c, mesh.points, 0.1, {{1, 0, 0}, {100, 0, 0}}).empty());
}

/// Strokes are drawn in the same places wherever the surface lies.
TEST(Hatching, FarFromTheOrigin) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  for (Point& p : mesh.points)
    for (double& x : p) x = std::round(x * 1024) / 1024;  // exact after the shift
  TriangleMesh away = mesh;
  for (Point& p : away.points)
    for (double& x : p) x += 0x1p28;
  const auto strokes = [](const TriangleMesh& m) {
    const Connection c = connection_of(m);
    return hatched(m, c, direction_field(c, 2), {.spacing = 0.1}).triangles.size();
  };
  EXPECT_NEAR(static_cast<double>(strokes(away)) / static_cast<double>(strokes(mesh)), 1, 0.05);
}

}  // namespace
}  // namespace pelage
