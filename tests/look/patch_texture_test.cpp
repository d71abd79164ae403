#include "look/patch_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "base/random.h"
#include "catalog/shapes.h"
#include "discretise/grid_space.h"
#include "look/tessellation.h"
#include "look/viewer.h"
#include "pelage/error.h"
#include "shape/atlas.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using Field = std::function<double(const Point&)>;

/// A field "u" on an atlas.
CoatFields coat_on(Atlas atlas, const Field& field) {
  CoatFields f;
  f.shape = std::make_shared<const TriangleMesh>(mesh_of(atlas));
  f.points = f.shape->points;
  f.space = std::make_shared<const GridSpace>(atlas);
  f.nodes = std::make_shared<const NodeShape>(std::move(atlas));
  f.species = {"u"};
  f.coefficients.emplace_back();
  for (const Point& p : f.points) f.coefficients[0].push_back(field(p));
  f.uniform = {0};
  return f;
}

Atlas atlas_of(const std::string& name) { return *as<Atlas>(find_shape(name).nodes); }

/// A flat sheet from `corner` on, along x and y, or along y and x.
Atlas::Patch flat_patch(const std::string& name, std::int32_t nx, std::int32_t ny, double x0, bool swapped = false) {
  Atlas::Patch patch;
  patch.name = name;
  patch.grid.count = {swapped ? ny : nx, swapped ? nx : ny, 1};
  for (std::int32_t j = 0; j < patch.grid.count[1]; ++j)
    for (std::int32_t i = 0; i < patch.grid.count[0]; ++i) {
      const double x = static_cast<double>(swapped ? j : i) / (nx - 1),
                   y = static_cast<double>(swapped ? i : j) / (ny - 1);
      patch.grid.points.push_back({x0 + x, y, 0});
    }
  return patch;
}

/// As graphics hardware makes smaller copies.
Image halved(const Image& image) {
  Image half{image.width / 2, image.height / 2, {}};
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = [&](int i, int j) {
          return image.rgb[3 * (static_cast<std::size_t>(j) * image.width + i) + k];
        };
        half.rgb.push_back((at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1)) /
                           4);
      }
  return half;
}

/// look(face, weights of its corners, u, v) at some places on the mesh.
template <class See>
void at_places(const TriangleMesh& mesh, const Attribute& uv, const See& see) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    double v = uniform(f, 0), w = uniform(f, 1);
    if (v + w > 1) v = 1 - v, w = 1 - w;
    const std::array<double, 3> share = {1 - v - w, v, w};
    std::array<double, 2> place{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 2; ++c) place[c] += share[k] * uv.values[2 * (3 * f + k) + c];
    see(f, share, place[0], place[1]);
  }
}

TEST(PatchLayout, ChartsLieApartAndFillTheSquareAsTheyCan) {
  for (const char* name : {"builtin:vase", "builtin:cube-sphere", "builtin:moebius"}) {
    const Atlas atlas = atlas_of(name);
    const PatchLayout layout = lay_out(atlas, 1024);
    ASSERT_EQ(layout.charts.size(), atlas.patches.size());
    double area = 0;
    for (std::size_t a = 0; a < layout.charts.size(); ++a) {
      const auto& c = layout.charts[a];
      EXPECT_GE(c.width, atlas.patches[a].grid.count[0]);
      EXPECT_GE(c.height, atlas.patches[a].grid.count[1]);
      EXPECT_GE(std::min(c.x, c.y), layout.gutter);
      EXPECT_LE(std::max(c.x + c.width, c.y + c.height), layout.size - layout.gutter);
      area += double(c.width) * c.height;
      for (std::size_t b = 0; b < a; ++b) {
        const auto& d = layout.charts[b];
        EXPECT_TRUE(c.x + c.width + 2 * layout.gutter <= d.x || d.x + d.width + 2 * layout.gutter <= c.x ||
                    c.y + c.height + 2 * layout.gutter <= d.y || d.y + d.height + 2 * layout.gutter <= c.y);
      }
    }
    if (atlas.patches.size() == 6) {
      EXPECT_GT(area, 0.5 * 1024 * 1024);
    }  // three beside each other, twice
  }
}

TEST(PatchLayout, SaysWhichSizeWouldDo) {
  const Atlas atlas = atlas_of("builtin:vase");
  std::string message;
  try {
    lay_out(atlas, 32);
  } catch (const Error& error) {
    message = error.what();
  }
  const std::size_t place = message.find("; ");
  ASSERT_NE(place, std::string::npos) << message;
  const int enough = std::stoi(message.substr(place + 2));
  EXPECT_NO_THROW(lay_out(atlas, enough));
  EXPECT_THROW(lay_out(atlas, enough / 2), Error);
}

/// A linear field is what it is at every place, whichever way a patch lies: uv, texels and their order agree.
TEST(PatchImages, ShowTheFieldWhereItIs) {
  const Atlas atlas = sew({flat_patch("a", 9, 6, 0), flat_patch("b", 12, 6, 1, true), flat_patch("c", 5, 4, 3)});
  const auto field = [](const Point& p) { return 0.1 + 0.15 * p[0] + 0.2 * p[1]; };
  const CoatFields coat = coat_on(atlas, field);
  const PatchLayout layout = lay_out(atlas, 128);
  const Image image = joined(patch_images(coat, painted("u"), layout), layout);
  at_places(*coat.shape, patch_uv(atlas, layout), [&](std::size_t f, const auto& share, double u, double v) {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        p[c] += share[k] * coat.shape->points[static_cast<std::size_t>(coat.shape->triangles[f][k])][c];
    EXPECT_NEAR(seen(image, u, v), field(p), 1e-6);
  });
}

/// Formulas count places from the middle of the whole shape, whichever texels are painted at a time.
TEST(PatchImages, HaveTheBoxOfTheWholeShape) {
  const Atlas atlas = sew({flat_patch("a", 9, 6, 0), flat_patch("b", 12, 6, 1), flat_patch("c", 5, 4, 3)});
  const CoatFields coat = coat_on(atlas, [](const Point& p) { return (p[0] - 2) / 2; });
  const PatchLayout layout = lay_out(atlas, 128);
  const auto shown = [&](const char* formula) { return joined(patch_images(coat, painted(formula), layout), layout); };
  EXPECT_EQ(shown("0.5 + 0.5*bx").rgb, shown("0.5 + 0.5*u").rgb);
}

/// The least distance of one that smaller copies may reach into the gutter.
TEST(PatchImages, SmallerCopiesFindNoOtherColours) {
  const Atlas atlas = sew({flat_patch("black", 9, 6, 0), flat_patch("white", 12, 6, 2)});
  const CoatFields coat = coat_on(atlas, [](const Point& p) { return p[0] > 1.5; });
  const PatchLayout layout = lay_out(atlas, 1024);
  Image image = joined(patch_images(coat, painted("u"), layout), layout);
  for (int copy = 0; (2 << copy) <= layout.gutter; ++copy) {
    at_places(*coat.shape, patch_uv(atlas, layout), [&](std::size_t f, const auto&, double u, double v) {
      const Point& p = coat.shape->points[static_cast<std::size_t>(coat.shape->triangles[f][0])];
      EXPECT_NEAR(seen(image, u, v), p[0] > 1.5 ? 1 : 0, 1e-9) << copy;
    });
    image = halved(image);
  }
}

TEST(PatchImages, AreThresholdsOfFieldsAndNoMeansOfColours) {
  const CoatFields coat = coat_on(atlas_of("builtin:cube-sphere"), [](const Point& p) { return std::sin(9 * p[0]); });
  const Atlas& atlas = *as<Atlas>(coat.nodes);
  for (const Image& image : patch_images(coat, painted("if(u > 0, 1, 0)"), lay_out(atlas, 512)))
    EXPECT_TRUE(std::ranges::all_of(image.rgb, [](float x) { return x == 0 || x == 1; }));
}

/// The places of the texels on the border of a patch, and their colours.
std::vector<std::pair<Point, double>> border_of(const Atlas::Patch& patch, const Image& image) {
  std::vector<std::pair<Point, double>> border;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (x % (image.width - 1) != 0 && y % (image.height - 1) != 0) continue;
      const double right = double(x) / (image.width - 1) * (patch.grid.count[0] - 1),
                   up = (1 - double(y) / (image.height - 1)) * (patch.grid.count[1] - 1);
      const auto i = std::min(static_cast<std::int32_t>(right), patch.grid.count[0] - 2),
                 j = std::min(static_cast<std::int32_t>(up), patch.grid.count[1] - 2);
      Point p{};
      for (const std::int32_t di : {0, 1})
        for (const std::int32_t dj : {0, 1})
          for (std::size_t k = 0; k < 3; ++k)
            p[k] += (di ? right - i : 1 - right + i) * (dj ? up - j : 1 - up + j) *
                    patch.grid.point(patch.grid.node(i + di, j + dj, 0))[k];
      border.emplace_back(p, image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x)]);
    }
  return border;
}

TEST(PatchImages, AgreeAlongSidesThatAreSewn) {
  for (const char* name : {"builtin:cube-sphere", "builtin:vase", "builtin:moebius"}) {
    const CoatFields coat = coat_on(
        atlas_of(name), [](const Point& p) { return 0.5 + 0.4 * std::sin(7 * p[0] + 3 * p[1]) * std::cos(5 * p[2]); });
    const Atlas& atlas = *as<Atlas>(coat.nodes);
    const std::vector<Image> images = patch_images(coat, painted("u"), lay_out(atlas, 700));
    std::vector<std::pair<Point, double>> border;
    for (std::size_t p = 0; p < images.size(); ++p)
      for (const auto& texel : border_of(atlas.patches[p], images[p])) border.push_back(texel);
    std::ranges::sort(border, {}, [](const auto& texel) { return texel.first[0]; });
    std::size_t shared = 0;
    for (std::size_t a = 0; a < border.size(); ++a)
      for (std::size_t b = a + 1; b < border.size() && border[b].first[0] - border[a].first[0] < 1e-9; ++b) {
        if (length(difference(border[a].first, border[b].first)) > 1e-9) continue;
        ++shared;
        EXPECT_NEAR(border[a].second, border[b].second, 1e-6) << name;
      }
    EXPECT_GT(shared, border.size() / 16) << name;  // the least of them are sewn on a band
  }
}

/// A band with one side: on its patch normals turn over from the begin to the end, but for their length they are those
/// of its formula.
TEST(PatchImages, NormalsLookToTheSideOfThePatch) {
  const CoatFields coat = coat_on(atlas_of("builtin:moebius?refine=2"), [](const Point&) { return 0.0; });
  const Atlas& atlas = *as<Atlas>(coat.nodes);
  ASSERT_TRUE(atlas.one_sided);
  const Image image = patch_images(coat, painted("0.5 + 0.5*nz"), lay_out(atlas, 512))[0];
  std::vector<double> middle;
  for (int x = 0; x < image.width; ++x)
    middle.push_back(2 * image.rgb[3 * (static_cast<std::size_t>(image.height / 2) * image.width + x)] - 1);
  const double sign = middle[0] > 0 ? 1 : -1;
  for (std::size_t x = 0; x < middle.size(); ++x)  // the band turns by half a circle around its middle line
    EXPECT_NEAR(sign * middle[x], std::cos(std::numbers::pi * static_cast<double>(x) / (image.width - 1)), 0.05) << x;
}

/// Every vertex looks to the side of its triangles, also where the band turns over; what is there twice is the same.
TEST(OneSidedCoats, HaveNormalsEverywhere) {
  const CoatFields coat = coat_on(atlas_of("builtin:moebius"), [](const Point& p) { return p[0] + 2 * p[1]; });
  const Tessellation t = tessellate(coat, {.curvature = true});
  EXPECT_EQ(t.samples.size(), coat.points.size() + 33);
  for (const Triangle& triangle : t.triangles) {
    const auto place = [&](std::size_t k) { return t.samples.position[static_cast<std::size_t>(triangle[k])]; };
    const Point face = unit(cross(difference(place(1), place(0)), difference(place(2), place(0))));
    for (const std::int32_t v : triangle)
      EXPECT_GT(dot(t.samples.normal[static_cast<std::size_t>(v)], face), 0.99) << v;
  }
  for (std::size_t v = 0; v < t.samples.size(); ++v) {
    const Point& p = t.samples.position[v];
    EXPECT_NEAR(t.samples.fields[0][v], p[0] + 2 * p[1], 1e-12);
    EXPECT_LT(t.samples.curvature.k1[v] * t.samples.curvature.k2[v], 0.05) << v;  // a ruled surface
  }
}

}  // namespace
}  // namespace pelage
