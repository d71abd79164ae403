#include "look/bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/parallel.h"
#include "base/srgb.h"
#include "look/baked_coat.h"
#include "pelage/io.h"
#include "shape/locate.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using std::numbers::pi;

double waves(const Point& p) { return 0.5 + 0.3 * std::sin(5 * p[0]) * std::cos(4 * p[1] + 3 * p[2]); }

/// A field that is known everywhere, at places that the limit surface itself gives: what the images show is that.
TEST(Bake, ShowsTheFieldWhereTheSurfaceIsSeamsIncluded) {
  for (const Method* method : {&remeshed_method, &loop_method}) {
    const Coat coat(torus(1000), *method, 0.03, waves);
    const BakedCoat result = baked(coat, painted("u"), 1024);
    ASSERT_EQ(result.tiles.size(), 1u);
    EXPECT_EQ(result.hidden.count, 0u);
    const SurfaceEvaluator surface = coat.surface();
    double sum = 0;
    std::vector<double> errors;
    at_random_places(*coat.fields.shape, 100'000, [&](const MeshPlace& place, const std::array<double, 2>& uv) {
      const double exact = waves(surface.at(place.face, place.v, place.w).position);
      errors.push_back(255 *
                       std::abs(srgb_from_linear(seen(result.tiles[0].color, uv[0], uv[1])) - srgb_from_linear(exact)));
      sum += errors.back();
    });
    std::ranges::sort(errors);
    EXPECT_LT(sum / static_cast<double>(errors.size()), 1) << method->name;
    EXPECT_LT(errors[errors.size() * 999 / 1000], 3) << method->name;
  }
}

/// Hills of nine texels and more, at which plain samples miss by 3.8/255.
TEST(Bake, InterpolationTakesLittleAwayFromHills) {
  const Field hills = [](const Point& p) { return 0.5 + 0.4 * std::sin(15 * p[0]) * std::cos(15 * p[1] + 9 * p[2]); };
  const Coat coat(torus(1000), remeshed_method, 0.02, hills);
  const BakedCoat result = baked(coat, painted("u"), 384);
  const SurfaceEvaluator surface = coat.surface();
  std::vector<double> errors;
  at_random_places(*coat.fields.shape, 30'000, [&](const MeshPlace& place, const std::array<double, 2>& uv) {
    const double exact = hills(surface.at(place.face, place.v, place.w).position);
    errors.push_back(255 * std::abs(seen(result.tiles[0].color, uv[0], uv[1]) - exact));
  });
  std::ranges::sort(errors);
  EXPECT_LT(errors[errors.size() * 999 / 1000], 3);
}

/// A mesh with uv of its own, which is laid into the image where it reaches over several.
TriangleMesh shared_mesh(const std::string& path) {
  TriangleMesh mesh = read_shape(path).mesh;
  Attribute& uv = *mesh.find("uv");
  double furthest = 0;
  for (const double x : uv.values) furthest = std::max(furthest, x);
  for (std::size_t i = 0; furthest > 2 && i < uv.values.size(); ++i)
    uv.values[i] = 0.02 + 0.96 * uv.values[i] / (i % 2 == 0 ? 32.001 : 2.001);
  return mesh;
}

double length_of_texel(const TriangleMesh& mesh, Index face, int size) {
  const auto first = mesh.find("uv")->values.begin() + 6 * face;
  return texel_length({mesh.points, {mesh.triangles[static_cast<std::size_t>(face)]}, {}, {}, {}},
                      {"uv", 2, Domain::corner, {first, first + 6}}, size, 0);
}

double fine_waves(const Point& p) { return std::sin(50 * p[0]) * std::cos(40 * p[1] + 30 * p[2]); }

/// A pattern of the size of spots on meshes of others, against the field at the nearest place of its own mesh among
/// all, from where the limit surface lies.
TEST(Bake, ShowsTheFieldOfItsOwnMeshOnMeshesOfOthers) {
  for (const char* name : {"spot_uv_2930.obj", "knot_uv_1440.obj"}) {
    const std::string path = std::string(PELAGE_SHARED_MESHES) + "/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    TriangleMesh shape = shared_mesh(path);
    const double size = box_of(shape.points).diagonal();
    for (Point& p : shape.points)
      for (double& x : p) x *= 3 / size;
    const Coat coat(std::move(shape), remeshed_method, 0.015, fine_waves);
    const BakedCoat result = baked(coat, painted("0.5 + 0.4*u"), 2048);
    const SurfaceEvaluator surface = coat.surface();
    const Topology& mesh = *coat.fields.mesh->shared_topology();
    const SurfaceWalk walk(mesh, coat.fields.space->control());
    const MeshFields anywhere(mesh.triangles, coat.fields.space->control(), coat.fields.coefficients);
    constexpr double wave = 0.1, texels_of_wave = 12;
    double sum = 0;
    std::vector<double> errors;
    at_random_places(*coat.fields.shape, 100'000, [&](const MeshPlace& place, std::array<double, 2> uv) {
      for (double& x : uv) x -= std::floor(x);
      if (std::min(uv[0], uv[1]) < 0.001 || std::max(uv[0], uv[1]) > 0.999) return;  // seen() does not repeat
      if (texels_of_wave * length_of_texel(*coat.fields.shape, place.face, 2048) > wave) return;
      const SurfaceSample at = surface.at(place.face, place.v, place.w);
      const MeshPlace nearest = walk.search(Eigen::Vector3d(at.position.data()), Eigen::Vector3d(at.normal.data()));
      errors.push_back(255 * std::abs(srgb_from_linear(seen(result.tiles[0].color, uv[0], uv[1])) -
                                      srgb_from_linear(0.5 + 0.4 * anywhere.at(0, nearest))));
      sum += errors.back();
    });
    std::ranges::sort(errors);
    EXPECT_EQ(result.hidden.count, 0u) << name;
    EXPECT_GT(errors.size(), 75'000u) << name;
    RecordProperty(std::string(name) + "_count", std::to_string(errors.size()));
    RecordProperty(std::string(name) + "_mean", std::to_string(sum / static_cast<double>(errors.size())));
    RecordProperty(std::string(name) + "_999", std::to_string(errors[errors.size() * 999 / 1000]));
    EXPECT_LT(sum / static_cast<double>(errors.size()), 1) << name;
    EXPECT_LT(errors[errors.size() * 999 / 1000], 3) << name;
  }
}

TEST(Bake, GuttersShowTheSurfaceBeyondTheBorder) {
  const Coat coat(torus(1000), remeshed_method, 0.05, waves);
  const BakedCoat result = baked(coat, painted("u"), 1024);
  const std::vector<Triangle>& triangles = coat.fields.shape->triangles;
  const UvLayout layout(triangles, *coat.fields.shape->find("uv"), 1024);
  std::vector<Index> hidden;
  std::size_t gutter = 0;
  double worst = 0;
  for (const UvLayout::Texel& t : layout.texels(0, 0, 1024, hidden)) {
    if (t.inside) continue;
    ++gutter;
    // The angles go on beyond the seams.
    const double a = 2 * pi * (((t.x + 0.5) / 1024 - 0.1) / 0.7 - 0.5),
                 b = 2 * pi * (((1 - (t.y + 0.5) / 1024) - 0.1) / 0.7 - 0.5);
    const double ring = 1 + 0.4 * std::cos(b);
    const std::size_t texel = static_cast<std::size_t>(t.y) * 1024 + static_cast<std::size_t>(t.x);
    worst = std::max(worst, std::abs(linear_from_srgb(result.tiles[0].color.bytes[3 * texel] / 255.0) -
                                     waves({ring * std::cos(a), ring * std::sin(a), 0.4 * std::sin(b)})));
  }
  EXPECT_GT(gutter, 4u * 700 * 8);
  EXPECT_LT(worst, 0.03);  // the mesh of a torus is a little smaller than a torus; the field runs from 0.2 to 0.8
}

/// Its uv moved to (a u + b v, v) + (c, 0).
TriangleMesh with_uv(TriangleMesh mesh, double a, double b, double c) {
  Attribute uv = *mesh.find("uv");
  for (std::size_t i = 0; i < uv.values.size(); i += 2) uv.values[i] = a * uv.values[i] + b * uv.values[i + 1] + c;
  mesh.set(std::move(uv));
  return mesh;
}

/// Normals against those of the surface that the height has really displaced.
void expect_normals_of_the_displaced_surface(TriangleMesh shape, bool mirrored) {
  const Coat coat(std::move(shape), remeshed_method, 0.03, waves);
  Look look = painted("u");
  look.channels[Channel::height] = {"0.4*u", {}};  // in wavelengths
  const BakedCoat result = baked(coat, look, 1024, true);
  const double unit_of_height = 0.4 * coat.fields.wavelength;
  const SurfaceEvaluator surface = coat.surface();
  const ShadingFrames frames(*coat.fields.shape);
  double sum = 0, bent = 0, count = 0;
  at_random_places(*coat.fields.shape, 3000, [&](const MeshPlace& place, const std::array<double, 2>& uv) {
    const auto displaced = [&](double v, double w) {
      const SurfaceSample s = surface.at(place.face, v, w);
      Point p = s.position;
      for (std::size_t k = 0; k < 3; ++k) p[k] += unit_of_height * waves(s.position) * s.normal[k];
      return p;
    };
    constexpr double d = 0.02;
    const double v = std::clamp(place.v, d, 1 - 3 * d), w = std::clamp(place.w, d, 1 - 2 * d - v);
    const Point truth = unit(cross(difference(displaced(v + d, w), displaced(v - d, w)),
                                   difference(displaced(v, w + d), displaced(v, w - d))));
    const std::size_t texel =
        static_cast<std::size_t>((1 - uv[1]) * 1024) * 1024 + static_cast<std::size_t>(uv[0] * 1024);
    const auto mean = [&](const std::vector<Point>& at_corners) {
      Point m{};
      const std::size_t corner = 3 * static_cast<std::size_t>(place.face);
      for (std::size_t k = 0; k < 3; ++k)
        m[k] = (1 - v - w) * at_corners[corner][k] + v * at_corners[corner + 1][k] + w * at_corners[corner + 2][k];
      return unit(m);
    };
    const Point normal = mean(frames.normal), tangent = mean(frames.tangent), bitangent = cross(normal, tangent);
    EXPECT_EQ(frames.mirrored[3 * static_cast<std::size_t>(place.face)], mirrored);
    Point shown{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint8_t* rgb = &result.tiles[0].normal.bytes[3 * texel];
      shown[k] = (rgb[0] / 127.5 - 1) * tangent[k] + (rgb[1] / 127.5 - 1) * (mirrored ? -bitangent[k] : bitangent[k]) +
                 (rgb[2] / 127.5 - 1) * normal[k];
    }
    sum += std::acos(std::min(1.0, dot(unit(shown), truth))) * 180 / pi;
    bent += std::acos(std::min(1.0, dot(surface.at(place.face, v, w).normal, truth))) * 180 / pi;
    ++count;
  });
  EXPECT_GT(bent / count, 5);  // otherwise there is nothing to see
  EXPECT_LT(sum / count, 2);
}

TEST(Bake, NormalMapsAreTheNormalsOfTheDisplacedSurface) {
  expect_normals_of_the_displaced_surface(torus(6000), false);
}

TEST(Bake, NormalMapsOnObliqueCharts) {
  expect_normals_of_the_displaced_surface(with_uv(torus(6000), 0.6, 0.35, 0), false);
}

TEST(Bake, NormalMapsOnMirroredCharts) {
  expect_normals_of_the_displaced_surface(with_uv(torus(6000), -1, 0, 0.9), true);
}

TEST(Bake, DoesNotDependOnTheThreads) {
  const Coat coat(torus(500), remeshed_method, 0.06, waves);
  const BakedCoat two = baked(coat, painted("u + 0.1*bx"), 128);
  const ThreadLimit one(1);
  EXPECT_EQ(baked(coat, painted("u + 0.1*bx"), 128).tiles[0].color.bytes, two.tiles[0].color.bytes);
}

TEST(Bake, ChannelsAreImages) {
  const Coat coat(torus(500), remeshed_method, 0.06, waves);
  Look look = painted("0.5");
  look.channels[Channel::roughness] = {"u", {}};
  look.channels[Channel::opacity] = {"0.25", {}};
  look.channels[Channel::emission] = {"0.5", {}};
  const BakedTile tile = std::move(baked(coat, look, 128).tiles[0]);
  const std::size_t middle = 64 * 128 + 64;
  EXPECT_NEAR(tile.greys.at(Channel::roughness).bytes[middle], 255 * tile.height[middle], 0.51);
  EXPECT_EQ(tile.greys.at(Channel::opacity).bytes[middle], 64);
  EXPECT_EQ(tile.emission.bytes[3 * middle], srgb_byte(0.25));
  EXPECT_TRUE(tile.normal.bytes.empty());
  EXPECT_FALSE(tile.greys.contains(Channel::metalness));
}

}  // namespace
}  // namespace pelage
