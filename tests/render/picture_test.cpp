#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "pelage/error.h"
#include "pelage/render.h"
#include "shape/generators.h"

namespace pelage {
namespace {

/// A sphere of one colour, with exact normals.
TriangleMesh ball(double red, double green, double blue) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=2000");
  Attribute normal{"normal", 3, Domain::vertex, {}}, color{"color", 3, Domain::vertex, {}};
  for (const Point& p : mesh.points) {
    normal.values.insert(normal.values.end(), p.begin(), p.end());
    for (double c : {red, green, blue}) color.values.push_back(c);
  }
  mesh.attributes = {normal, color};
  return mesh;
}

PictureOptions small() {
  PictureOptions options;
  options.width = options.height = 96;
  options.samples = 16;
  return options;
}

/// Mean of one channel over a square of the picture, given in hundredths of its size.
double mean(const Image& image, int left, int top, int size, int channel) {
  double sum = 0;
  int count = 0;
  for (int y = image.height * top / 100; y < image.height * (top + size) / 100; ++y)
    for (int x = image.width * left / 100; x < image.width * (left + size) / 100; ++x, ++count)
      sum += static_cast<double>(image.rgb[3 * (y * image.width + x) + channel]);
  return sum / count;
}

TEST(Picture, SameBitsForAnyNumberOfThreads) {
  const TriangleMesh mesh = ball(0.8, 0.4, 0.1);
  std::vector<std::vector<float>> pictures;
  for (int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    pictures.push_back(render(mesh, small()).rgb);
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[0], pictures[2]);
}

TEST(Picture, ColourArrivesAndLightComesFromAboveLeft) {
  const Image image = render(ball(0.8, 0.4, 0.1), small());
  const double red = mean(image, 35, 30, 20, 0), green = mean(image, 35, 30, 20, 1), blue = mean(image, 35, 30, 20, 2);
  EXPECT_NEAR(green / red, 0.5, 0.08);
  EXPECT_LT(blue, 0.35 * red);
  EXPECT_GT(mean(image, 30, 30, 8, 0), 1.3 * mean(image, 65, 65, 8, 0));
}

TEST(Picture, BackdropIsPlainAndTheShadowLiesRightOfTheBall) {
  const PictureOptions options = small();
  const Image image = render(ball(0.5, 0.5, 0.5), options);
  for (int left : {1, 90}) EXPECT_NEAR(mean(image, left, 10, 8, 1), options.background[1], 0.25);
  EXPECT_LT(mean(image, 86, 80, 10, 1), 0.93 * mean(image, 2, 80, 10, 1));
}

TEST(Picture, NothingBrighterThanLightAllows) {
  // A white ball on white paper: a surface returns no more than it receives, the lamp's highlight aside.
  PictureOptions options = small();
  options.background = {1, 1, 1};
  const Image image = render(ball(1, 1, 1), options);
  for (float c : image.rgb) EXPECT_TRUE(c >= 0 && c < 1.5F) << c;
}

TEST(Picture, UpAxisZIsTheTurnedYPicture) {
  TriangleMesh mesh = ball(0.3, 0.5, 0.7);
  for (Point& p : mesh.points) p = {2 * p[0], p[1], p[2]};
  TriangleMesh turned = mesh;  // y up -> z up: (x, y, z) -> (x, -z, y)
  for (Point& p : turned.points) p = {p[0], -p[2], p[1]};
  std::vector<double>& n = turned.find("normal")->values;
  for (std::size_t i = 0; i < n.size(); i += 3) {
    const double y = n[i + 1];
    n[i + 1] = -n[i + 2];
    n[i + 2] = y;
  }
  PictureOptions options = small();
  const Image upright = render(mesh, options);
  options.up = UpAxis::z;
  EXPECT_EQ(render(turned, options).rgb, upright.rgb);
}

TEST(Picture, SizeAndPlaceOfTheObjectDoNotMatter) {
  TriangleMesh mesh = ball(0.3, 0.5, 0.7);
  const Image before = render(mesh, small());
  for (Point& p : mesh.points)
    for (double& x : p) x = 1024 * x + 4096;
  const Image after = render(mesh, small());
  double worst = 0;
  for (int i = 0; i < 100; i += 4)
    for (int j = 0; j < 100; j += 4)
      for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(mean(before, i, j, 4, c) - mean(after, i, j, 4, c)));
  EXPECT_LT(worst, 0.02);
}

TEST(Picture, WithoutNormalsAndColoursFlatAndGrey) {
  TriangleMesh mesh = builtin_shape("builtin:cube?n=200");
  PictureOptions options = small();
  options.width = 128;
  const Image image = render(mesh, options);
  EXPECT_EQ(image.width, 128);
  EXPECT_NEAR(mean(image, 45, 45, 10, 0), mean(image, 45, 45, 10, 2), 0.12);
}

TEST(Picture, ProgressAndCancel) {
  std::vector<double> fractions;
  render(ball(1, 0, 0), small(), [&](std::string_view, double f) { return fractions.push_back(f), true; });
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  try {
    render(ball(1, 0, 0), small(), [](std::string_view, double) { return false; });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::cancelled);
  }
}

TEST(Picture, RefusesWhatMakesNoPicture) {
  PictureOptions options = small();
  options.width = 0;
  EXPECT_THROW(render(ball(1, 1, 1), options), Error);
  options = small();
  options.samples = 0;
  EXPECT_THROW(render(ball(1, 1, 1), options), Error);
  EXPECT_THROW(render({}, small()), Error);
  TriangleMesh point;
  point.points = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  point.triangles = {{0, 1, 2}};
  EXPECT_THROW(render(point, small()), Error);
}

}  // namespace
}  // namespace pelage
