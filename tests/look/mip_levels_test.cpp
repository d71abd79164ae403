#include "look/mip_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "base/srgb.h"
#include "look/baked_coat.h"
#include "look/surface_blur.h"

namespace pelage {
namespace {

using std::numbers::pi;

/// The unit square in n x n x 2 triangles.
TriangleMesh square(int n) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.push_back({double(i) / n, double(j) / n, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  return mesh;
}

/// A Gaussian hill, and stripes that end at the border of the square, blurred from level to level.
TEST(SurfaceBlur, IsAGaussianOnAFlatPatch) {
  const TriangleMesh mesh = square(100);
  const SurfaceBlur surface(mesh.triangles, mesh.points);
  const double narrow = 0.05;
  const auto hill = [&](const Point& p, double variance) {
    const double all = narrow * narrow + variance;
    return narrow * narrow / all * std::exp(-(std::pow(p[0] - 0.5, 2) + std::pow(p[1] - 0.5, 2)) / (2 * all));
  };
  const auto stripes = [&](const Point& p, double variance) {
    return std::cos(6 * pi * p[0]) * std::exp(-36 * pi * pi * variance / 2);
  };
  std::vector<Vector> values(2, Vector(static_cast<Eigen::Index>(mesh.points.size())));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    values[0][static_cast<Eigen::Index>(i)] = hill(mesh.points[i], 0);
    values[1][static_cast<Eigen::Index>(i)] = stripes(mesh.points[i], 0);
  }
  double variance = 0;
  for (const double sigma : {0.01, 0.02, 0.04, 0.08}) {
    surface.blur(values, sigma * sigma - variance);
    variance = sigma * sigma;
    double worst_hill = 0, worst_stripes = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      worst_hill = std::max(worst_hill, std::abs(values[0][row] - hill(mesh.points[i], variance)));
      worst_stripes = std::max(worst_stripes, std::abs(values[1][row] - stripes(mesh.points[i], variance)));
    }
    RecordProperty("hill_" + std::to_string(sigma), std::to_string(worst_hill / hill({0.5, 0.5, 0}, variance)));
    EXPECT_LT(worst_hill, 0.02 * hill({0.5, 0.5, 0}, variance)) << sigma;
    EXPECT_LT(worst_stripes, 0.02) << sigma;
  }
}

TEST(SurfaceBlur, KeepsTheMeanOfColours) {
  const TriangleMesh mesh = torus(1000);
  const SurfaceBlur surface(mesh.triangles, mesh.points);
  std::vector<Vector> values(1, Vector(static_cast<Eigen::Index>(mesh.points.size())));
  for (Eigen::Index i = 0; i < values[0].size(); ++i) values[0][i] = uniform(3, static_cast<std::uint64_t>(i)) < 0.3;
  const double mean = surface.mean(values[0]);
  surface.blur(values, 0.05);
  EXPECT_NEAR(surface.mean(values[0]), mean, 1e-6);
  surface.blur(values, 100);  // farther than the torus is wide: nothing is left but the mean
  EXPECT_NEAR(values[0].maxCoeff(), mean, 1e-3);
  EXPECT_NEAR(values[0].minCoeff(), mean, 1e-3);
}

/// Two by two, as graphics hardware makes smaller copies.
Pixels halved(const Pixels& image) {
  Pixels half{image.width / 2, image.height / 2, image.channels, {}};
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        double light = 0;
        for (const int k : {0, 1, 2, 3}) {
          const int texel = (2 * y + k / 2) * image.width + 2 * x + k % 2;
          light += linear_from_srgb(image.bytes[static_cast<std::size_t>(texel * image.channels + c)] / 255.0) / 4;
        }
        half.bytes.push_back(srgb_byte(light));
      }
  return half;
}

/// How much the colours differ that the two sides of seams see of the same place, as a root mean square.
double jump_at_seams(const TriangleMesh& mesh, const Pixels& image) {
  const std::vector<double>& uv = mesh.find("uv")->values;
  std::map<std::pair<int, int>, std::size_t> edges;
  double sum = 0, count = 0;
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const std::size_t next = c % 3 == 2 ? c - 2 : c + 1;
    const int a = mesh.triangles[c / 3][c % 3], b = mesh.triangles[next / 3][next % 3];
    edges[{a, b}] = c;
    const auto other = edges.find({b, a});
    if (other == edges.end()) continue;
    const std::size_t d = other->second, after = d % 3 == 2 ? d - 2 : d + 1;
    const auto middle = [&](std::size_t from, std::size_t to) {
      return seen(image, (uv[2 * from] + uv[2 * to]) / 2, (uv[2 * from + 1] + uv[2 * to + 1]) / 2);
    };
    if (std::abs(uv[2 * c] - uv[2 * after]) + std::abs(uv[2 * c + 1] - uv[2 * after + 1]) < 1e-9) continue;
    sum += std::pow(middle(c, next) - middle(d, after), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

/// What lookups find on the mesh.
double mean_of(const TriangleMesh& mesh, const Pixels& image) {
  constexpr std::size_t count = 20'000;
  double sum = 0;
  at_random_places(mesh, count,
                   [&](const MeshPlace&, const std::array<double, 2>& uv) { sum += seen(image, uv[0], uv[1]); });
  return sum / count;
}

/// A coat that is painted as thick as the field says, in white on black.
struct PaintedTorus {
  explicit PaintedTorus(Field field) : coat(torus(1000), remeshed_method, 0.06, field) {}

  const Coat coat;
  const Look look = painted("u");
  const Paint paint = resolve_paint(look, coat.fields.species);
  const Tessellation tessellation = tessellate(coat.fields, tessellation_request(look, paint));
  const Palette palette = make_palette(paint, tessellation.samples, coat.fields.uniform);
  const CoatSampler sampler{coat.fields, tessellation, paint};
};

/// Around charts lies what the surface has beyond their borders, not the colour of the border.
TEST(MipLevels, DoNotBleedAcrossSeams) {
  const auto spots = [](const Point& p) { return 0.5 + 0.4 * std::sin(3 * p[0] + 1) * std::cos(3 * p[1] + 2 * p[2]); };
  const PaintedTorus torus(spots);
  const TriangleMesh& shape = *torus.coat.fields.shape;
  const UvLayout layout(shape.triangles, *shape.find("uv"), 256);
  const std::vector<Pixels> levels = mip_levels(torus.sampler, torus.palette, shape, layout)[0];
  ASSERT_EQ(levels.size(), 8u);
  Pixels box = bake(torus.sampler, torus.palette, layout, nullptr).tiles[0].color;
  const double mean = mean_of(shape, box);
  for (int k = 0; k < 5; ++k) {
    const Pixels& own = levels[static_cast<std::size_t>(k)];
    box = halved(box);
    ASSERT_EQ(own.width, box.width);
    const double jump = jump_at_seams(shape, own), of_box = jump_at_seams(shape, box);
    RecordProperty("level_" + std::to_string(k + 1), std::to_string(jump) + " " + std::to_string(of_box));
    EXPECT_LT(jump, of_box / 2) << own.width;
    if (own.width >= 32) {
      EXPECT_NEAR(mean_of(shape, own), mean, 1e-3) << own.width;
    }
  }
}

/// Without looking at texels beside it.
double nearest(const Pixels& image, double u, double v) {
  const int texel = static_cast<int>((1 - v) * image.height) * image.width + static_cast<int>(u * image.width);
  return linear_from_srgb(image.bytes[static_cast<std::size_t>(image.channels * texel)] / 255.0);
}

/// Every level has the contrast of a single blur from the colours themselves, however many levels came before.
TEST(MipLevels, AreBlurredByHalfATexel) {
  const auto waves = [](const Point& p) { return 0.5 + 0.4 * std::sin(5 * p[0] + 1) * std::cos(4 * p[1] + 3 * p[2]); };
  const PaintedTorus torus(waves);
  const TriangleMesh& shape = *torus.coat.fields.shape;
  const Tessellation& t = torus.tessellation;
  const UvLayout layout(shape.triangles, *shape.find("uv"), 512);
  const std::vector<Pixels> levels = mip_levels(torus.sampler, torus.palette, shape, layout)[0];
  const SurfaceBlur surface(t.triangles, t.samples.position);
  const auto spread = [&](const Vector& u) {
    const double mean = surface.mean(u);
    return std::sqrt(surface.mean(Vector((u.array() - mean).square())));
  };
  const std::vector<double> colors = paint(t.samples, torus.palette);
  int compared = 0;
  for (const Pixels& level : levels) {
    const double texel = texel_length(shape, *shape.find("uv"), level.width, 0.5);
    if (texel < 0.1 || texel > 0.8) continue;  // baked as the image itself, or blurred until nothing is left
    std::vector<Vector> once(1, Vector(static_cast<Eigen::Index>(t.samples.size())));
    for (std::size_t i = 0; i < t.samples.size(); ++i) once[0][static_cast<Eigen::Index>(i)] = colors[3 * i];
    surface.blur(once, texel * texel / 4);
    double square = 0, sum = 0;
    constexpr std::size_t count = 20'000;
    at_random_places(shape, count, [&](const MeshPlace&, const std::array<double, 2>& uv) {
      const double light = nearest(level, uv[0], uv[1]);
      sum += light / count;
      square += light * light / count;
    });
    EXPECT_NEAR(std::sqrt(square - sum * sum) / spread(once[0]), 1, 0.04) << level.width;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

}  // namespace
}  // namespace pelage
