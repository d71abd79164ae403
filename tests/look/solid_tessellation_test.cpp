#include "look/solid_tessellation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discretise/tet_space.h"
#include "look/carving.h"
#include "pelage/error.h"
#include "shape/generators.h"
#include "shape/tet_mesh.h"
#include "shape/vectors.h"
#include "solid/fill.h"

namespace pelage {
namespace {

double f(const Point& p) { return 1 + 2 * p[0] - p[1] + 0.5 * p[2]; }

/// A field that is linear in space.
CoatFields fields_in(const TriangleMesh& shape, double edge) {
  CoatFields fields;
  TetMesh volume = fill(shape, edge, 1'000'000).volume;
  volume.surface = std::make_shared<const TriangleMesh>(shape);
  fields.shape = std::make_shared<const TriangleMesh>(mesh_of(volume));
  fields.space = std::make_shared<const TetSpace>(volume);
  fields.species = {"u"};
  fields.coefficients.emplace_back();
  for (const Point& p : volume.points) fields.coefficients[0].push_back(f(p));
  fields.uniform = {0};
  fields.wavelength = 2;
  fields.nodes = std::make_shared<const NodeShape>(std::move(volume));
  return fields;
}

TriangleMesh cube() { return builtin_shape("builtin:cube"); }

TEST(SolidTessellation, IsTheSurfaceWithItsEdgesAndItsCorners) {
  const CoatFields fields = fields_in(cube(), 0.2);
  const Tessellation t = tessellate(fields, {});
  const TriangleMesh shape = cube();
  EXPECT_TRUE(std::equal(shape.points.begin(), shape.points.end(), t.samples.position.begin()));
  double reach = 0;
  for (const Point& p : shape.points) reach = std::max(reach, std::abs(p[0]));
  double off = 0;
  for (std::size_t v = 0; v < t.samples.size(); ++v) {
    const Point& p = t.samples.position[v];
    EXPECT_NEAR(std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}), reach, 1e-12);
    // Nodes lie on the faces; what is cut off lies along the edges.
    std::array<double, 3> a{std::abs(p[0]), std::abs(p[1]), std::abs(p[2])};
    std::ranges::sort(a);
    const double error = std::abs(t.samples.fields[0][v] - f(p));
    if (a[1] < reach - 0.3) {
      EXPECT_LT(error, 1e-7);
    }
    off = std::max(off, error);
  }
  EXPECT_LT(off, 0.2 * length({2, -1, 0.5}));
}

TEST(SolidTessellation, KeepsTheShapeWhereAsked) {
  const CoatFields fields = fields_in(cube(), 0.2);
  Look look;
  look.keep_shape = true;
  const Tessellation t = tessellate(fields, tessellation_request(look));
  EXPECT_EQ(t.triangles, cube().triangles);
  EXPECT_EQ(t.samples.position, cube().points);
  look.keep_shape = false;
  look.detail = 2;
  EXPECT_EQ(tessellate(fields, tessellation_request(look)).triangles.size(), 16 * cube().triangles.size());
}

TEST(SolidTessellation, GoesWithTheSurface) {
  CoatFields fields = fields_in(cube(), 0.2);
  const Tessellation before = tessellate(fields, {});
  const auto moved = [](Point p) { return Point{2 * p[0] + p[1], p[1] - 3, p[2] + 0.5 * p[0]}; };
  for (const Point& p : cube().points) fields.surface.push_back(moved(p));
  const Tessellation after = tessellate(fields, {});
  EXPECT_EQ(after.samples.drawn_at, before.samples.position);
  EXPECT_EQ(after.samples.fields, before.samples.fields);
  for (std::size_t v = 0; v < after.samples.size(); ++v)
    EXPECT_LT(length(difference(after.samples.position[v], moved(before.samples.position[v]))), 1e-12);
  EXPECT_EQ(after.attributes.size(), before.attributes.size());
}

/// Faces are flat to their very edges; with cuts it is the skin of the tetrahedra.
TEST(SolidTessellation, NormalsAreThoseOfTheFaces) {
  const CoatFields fields = fields_in(cube(), 0.2);
  const TriangleMesh body = dress_body(fields, {}, {});
  const Attribute& normal = *body.find("normal");
  ASSERT_EQ(normal.domain, Domain::corner);
  for (std::size_t c = 0; c < normal.values.size(); c += 3)
    EXPECT_NEAR(std::max({std::abs(normal.values[c]), std::abs(normal.values[c + 1]), std::abs(normal.values[c + 2])}),
                1, 1e-12);
  Carving half;
  half.cuts.emplace_back("x>0", UpAxis::y);
  for (const Point& p : dress_body(fields, {}, half).points) EXPECT_LE(p[0], 1e-9);
  EXPECT_EQ(dress_nodes(fields, {}).points.size(), fields.coefficients[0].size());
}

}  // namespace
}  // namespace pelage
