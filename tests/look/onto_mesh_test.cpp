#include "look/onto_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "look/baked_coat.h"
#include "pelage/polygon_mesh.h"
#include "pelage/unwrap.h"
#include "shape/simplify.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

double waves(const Point& p) { return 0.5 + 0.3 * std::sin(5 * p[0]) * std::cos(4 * p[1] + 3 * p[2]); }

BakedTile baked_onto(const Coat& coat, const TriangleMesh& mesh, int size, const ShadingFrames* frames = nullptr) {
  const Look look = painted("u");
  const Paint paint = resolve_paint(look, coat.fields.species);
  const Tessellation t = tessellate(coat.fields, tessellation_request(look, paint));
  const OntoMesh onto(mesh, t);
  const UvLayout layout(mesh.triangles, *mesh.find("uv"), size);
  return std::move(bake(CoatSampler(coat.fields, t, paint, &onto), make_palette(paint, t.samples, coat.fields.uniform),
                        layout, frames)
                       .tiles[0]);
}

/// In bytes, over the texels that lie in faces.
struct Difference {
  double mean = 0;
  int worst = 0;
};
Difference difference_of(const Pixels& a, const Pixels& b, const TriangleMesh& mesh) {
  const UvLayout layout(mesh.triangles, *mesh.find("uv"), a.width);
  std::vector<Index> hidden;
  Difference d;
  double count = 0;
  for (const UvLayout::Texel& t : layout.texels(0, 0, a.width, hidden)) {
    if (!t.inside) continue;
    const std::size_t red = 3 * (static_cast<std::size_t>(t.y) * a.width + static_cast<std::size_t>(t.x));
    const int bytes = std::abs(a.bytes[red] - b.bytes[red]);
    d.worst = std::max(d.worst, bytes);
    d.mean += bytes;
    ++count;
  }
  d.mean /= count;
  return d;
}

/// Flat triangles lie on themselves; beyond the borders of charts, where without it colours end, they go on.
TEST(OntoMesh, OntoItselfIsAsWithoutIt) {
  const Coat coat(torus(1000), linear_method, 0.03, waves);
  const BakedTile plain = std::move(baked(coat, painted("u"), 256).tiles[0]),
                  onto = baked_onto(coat, *coat.fields.shape, 256);
  const Difference difference = difference_of(plain.color, onto.color, *coat.fields.shape);
  EXPECT_LE(difference.worst, 2);
  EXPECT_LT(difference.mean, 0.02);
}

/// Between flat triangles and the smooth surface of the same mesh lies an offset of second order, along the surface.
TEST(OntoMesh, OntoItsOwnControlMeshDiffersBySecondOrder) {
  std::vector<double> means;
  for (const int vertices : {500, 2000}) {
    const Coat coat(torus(vertices), remeshed_method, 0.03, waves);
    const BakedTile plain = std::move(baked(coat, painted("u"), 256).tiles[0]),
                    onto = baked_onto(coat, *coat.fields.shape, 256);
    means.push_back(difference_of(plain.color, onto.color, *coat.fields.shape).mean);
  }
  RecordProperty("means", std::to_string(means[0]) + " " + std::to_string(means[1]));
  EXPECT_LT(means[1], 0.5);
  EXPECT_LT(means[1], 0.5 * means[0]);
}

TriangleMesh with_atlas(TriangleMesh mesh, int size) {
  mesh.attributes.clear();
  mesh.set(unwrap(polygons_of(mesh), {size, 4}).uv);
  return mesh;
}

/// A sphere and the same in a few triangles: what these show is what the sphere has in their direction, and their
/// normals are its own.
TEST(OntoMesh, ADecimatedSphereShowsTheSphere) {
  const Coat coat(builtin_shape("builtin:sphere?n=2562"), remeshed_method, 0.03, waves);
  const TriangleMesh few = with_atlas(simplify(*coat.fields.shape, 300), 512);
  ASSERT_LE(few.triangles.size(), 300u);
  const ShadingFrames frames(few);
  const BakedTile tile = baked_onto(coat, few, 512, &frames);
  std::vector<double> errors, degrees;
  double sum = 0, of_normals = 0, of_mesh = 0;
  at_random_places(few, 20'000, [&](const MeshPlace& place, const std::array<double, 2>& uv) {
    const Point truth = unit(point_at(few.triangles, few.points, place));
    errors.push_back(255 * std::abs(srgb_from_linear(seen(tile.color, uv[0], uv[1])) - srgb_from_linear(waves(truth))));
    sum += errors.back();
    const auto mean = [&](const std::vector<Point>& at_corners) {
      Point m{};
      const std::size_t corner = 3 * static_cast<std::size_t>(place.face);
      for (std::size_t k = 0; k < 3; ++k)
        m[k] = (1 - place.v - place.w) * at_corners[corner][k] + place.v * at_corners[corner + 1][k] +
               place.w * at_corners[corner + 2][k];
      return unit(m);
    };
    const Point normal = mean(frames.normal), tangent = mean(frames.tangent), bitangent = cross(normal, tangent);
    const std::size_t texel = static_cast<std::size_t>((1 - uv[1]) * 512) * 512 + static_cast<std::size_t>(uv[0] * 512);
    const std::uint8_t* rgb = &tile.normal.bytes[3 * texel];
    Point shown{};
    for (std::size_t k = 0; k < 3; ++k)
      shown[k] =
          (rgb[0] / 127.5 - 1) * tangent[k] + (rgb[1] / 127.5 - 1) * bitangent[k] + (rgb[2] / 127.5 - 1) * normal[k];
    const auto apart = [&](const Point& n) { return std::acos(std::min(1.0, dot(n, truth))) * 180 / std::numbers::pi; };
    degrees.push_back(apart(unit(shown)));
    of_normals += degrees.back();
    of_mesh += apart(normal);
  });
  std::ranges::sort(errors);
  const auto count = static_cast<double>(errors.size());
  RecordProperty("color_mean", std::to_string(sum / count));
  RecordProperty("color_999", std::to_string(errors[errors.size() * 999 / 1000]));
  RecordProperty("normal_mean", std::to_string(of_normals / count) + " of " + std::to_string(of_mesh / count));
  EXPECT_LT(sum / count, 1);
  EXPECT_LT(errors[errors.size() * 999 / 1000], 3);
  EXPECT_LT(of_normals / count, 0.5);
  EXPECT_GT(of_mesh / count, 1);  // otherwise there is nothing to see
}

/// Two sheets of n x n squares and a rim; uv: the upper one fills the left half of the image, the lower one the right.
TriangleMesh plate(int n, double low, double high) {
  TriangleMesh mesh;
  Attribute uv{"uv", 2, Domain::corner, {}};
  const auto at = [n](int i, int j, int sheet) { return sheet * (n + 1) * (n + 1) + j * (n + 1) + i; };
  for (const double z : {low, high})
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.points.push_back({double(i) / n, double(j) / n, z});
  const auto add = [&](int a, int b, int c, bool shown) {
    mesh.triangles.push_back({a, b, c});
    for (const int v : {a, b, c}) {
      const Point& p = mesh.points[static_cast<std::size_t>(v)];
      uv.values.push_back(!shown ? 0 : p[2] == high ? 0.05 + 0.4 * p[0] : 0.95 - 0.4 * p[0]);
      uv.values.push_back(!shown ? 0 : 0.05 + 0.9 * p[1]);
    }
  };
  const auto quad = [&](int a, int b, int c, int d, bool shown) {
    add(a, b, c, shown);
    add(a, c, d, shown);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      quad(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1), true);
      quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0), true);
    }
  for (int k = 0; k < n; ++k) {
    quad(at(k, 0, 0), at(k + 1, 0, 0), at(k + 1, 0, 1), at(k, 0, 1), false);
    quad(at(n, k, 0), at(n, k + 1, 0), at(n, k + 1, 1), at(n, k, 1), false);
    quad(at(k + 1, n, 0), at(k, n, 0), at(k, n, 1), at(k + 1, n, 1), false);
    quad(at(0, k + 1, 0), at(0, k, 0), at(0, k, 1), at(0, k + 1, 1), false);
  }
  mesh.set(std::move(uv));
  return mesh;
}

/// A plate that is white above and black below, and a thinner one of few triangles, whose upper side lies nearer to the
/// lower side of the first one.
TEST(OntoMesh, ThinPartsDoNotTakeTheOtherSide) {
  const Coat coat(plate(40, 0, 0.01), linear_method, 0.03, [](const Point& p) { return p[2] > 0.005 ? 0.9 : 0.1; });
  const TriangleMesh few = plate(4, 0.001, 0.004);
  const BakedTile tile = baked_onto(coat, few, 256);
  const UvLayout layout(few.triangles, *few.find("uv"), 256);
  std::vector<Index> hidden;
  std::size_t count = 0;
  for (const UvLayout::Texel& t : layout.texels(0, 0, 256, hidden)) {
    if (!t.inside) continue;
    const std::size_t red = 3 * (static_cast<std::size_t>(t.y) * 256 + static_cast<std::size_t>(t.x));
    ASSERT_EQ(tile.color.bytes[red], srgb_byte(t.x < 128 ? 0.9 : 0.1)) << t.x << " " << t.y;
    ++count;
  }
  EXPECT_GT(count, 40'000u);
}

TEST(OntoMesh, WhatLiesFarAwayIsCounted) {
  const Coat coat(builtin_shape("builtin:sphere?n=642"), linear_method, 0.1, waves);
  TriangleMesh mesh = *coat.fields.shape;
  const Triangle moved = mesh.triangles[100];
  std::size_t around = 0;
  for (const Triangle& t : mesh.triangles) around += std::ranges::count(t, moved[0]) > 0;
  for (double& x : mesh.points[static_cast<std::size_t>(moved[0])]) x *= 1.25;
  const Tessellation t = tessellate(coat.fields, {});
  const OntoMesh onto(mesh, t);
  const FarTriangles far = onto.farther_than(0.2);
  EXPECT_EQ(far.count, around);
  EXPECT_EQ(std::ranges::count(mesh.triangles[static_cast<std::size_t>(far.first)], moved[0]), 1);
  EXPECT_NEAR(far.furthest, 0.25, 1e-3);
  EXPECT_EQ(onto.farther_than(0.3).count, 0u);
}

}  // namespace
}  // namespace pelage
