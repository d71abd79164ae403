#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/parallel.h"
#include "base/srgb.h"
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
  PictureOptions options = small();
  options.width = options.height = 512;
  options.samples = 4;
  std::vector<double> fractions;
  const TriangleMesh mesh = ball(1, 0, 0);
  render(mesh, options, [&](std::string_view, double f) { return fractions.push_back(f), true; });
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  for (std::size_t i = 1; i < fractions.size(); ++i) EXPECT_LT(fractions[i] - fractions[i - 1], 0.1);
  for (std::size_t stop = 0; stop < fractions.size(); stop += 5) {
    std::size_t reports = 0;
    try {
      render(mesh, options, [&](std::string_view, double) { return reports++ < stop; });
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::cancelled);
      EXPECT_EQ(reports, stop + 1);
    }
  }
}

/// A sphere with sharp black and white stripes, finer than the light.
TriangleMesh striped_ball() {
  TriangleMesh mesh = ball(0, 0, 0);
  std::vector<double>& color = mesh.find("color")->values;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    std::fill_n(color.begin() + 3 * static_cast<std::ptrdiff_t>(i), 3,
                std::sin(9 * mesh.points[i][1]) > 0 ? 0.8 : 0.05);
  return mesh;
}

TEST(Picture, EverySampleCountGivesTheSameBitsForAnyNumberOfThreads) {
  const TriangleMesh mesh = striped_ball();
  PictureOptions options = small();
  for (const int samples : {4, 32, 512}) {
    options.samples = samples;
    options.width = samples > 100 ? 24 : 300;  // several bands and squares
    std::vector<std::vector<float>> pictures;
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      pictures.push_back(render(mesh, options).rgb);
    }
    EXPECT_EQ(pictures[0], pictures[1]) << samples;
  }
}

double luminance(const Image& image, std::size_t pixel) {
  const float* c = image.rgb.data() + 3 * pixel;
  return 0.2126 * static_cast<double>(c[0]) + 0.7152 * static_cast<double>(c[1]) + 0.0722 * static_cast<double>(c[2]);
}

/// Compares a picture of the usual quality with one of many rays whose light is not smoothed: root mean square of the
/// difference over the mean luminance, and largest relative difference of the means over squares.
std::array<double, 2> error_of_usual_quality(const TriangleMesh& mesh, int size = 128) {
  PictureOptions options;
  options.width = options.height = size;
  PictureScene scene(mesh);
  const Image usual = scene.render(options);
  options.samples = 512;
  const Image exact = scene.render(options);
  double squares = 0, sum = 0, worst = 0;
  const std::size_t pixels = exact.rgb.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    squares += std::pow(luminance(usual, i) - luminance(exact, i), 2) / static_cast<double>(pixels);
    sum += luminance(exact, i) / static_cast<double>(pixels);
  }
  for (int y = 0; y < 100; y += 10)
    for (int x = 0; x < 100; x += 10)
      worst = std::max(worst, std::abs(mean(usual, x, y, 10, 1) / mean(exact, x, y, 10, 1) - 1));
  return {std::sqrt(squares) / sum, worst};
}

TEST(Picture, SmoothedLightIsThatOfManyRays) {
  const auto [deviation, worst] = error_of_usual_quality(ball(0.6, 0.5, 0.4));
  // In so small a picture shadows near the ball are a few pixels wide.
  EXPECT_LT(deviation, 0.013);
  EXPECT_LT(worst, 0.03);
}

TEST(Picture, StripesStaySharp) {
  // Smoothed with the light they would be off by a tenth.
  const auto [deviation, worst] = error_of_usual_quality(striped_ball());
  EXPECT_LT(deviation, 0.016);
  EXPECT_LT(worst, 0.03);
}

TriangleMesh finished_ball(const std::vector<std::pair<const char*, double>>& channels) {
  TriangleMesh mesh = ball(0.8, 0.6, 0.4);
  for (const auto& [name, value] : channels)
    mesh.set({name, 1, Domain::vertex, std::vector<double>(mesh.points.size(), value)});
  return mesh;
}

TEST(Picture, MaterialsAreThoseOfManyPaths) {
  const std::pair<const char*, double> frosted{"material_roughness", 0.5}, brushed{"material_roughness", 0.3};
  const auto metal = error_of_usual_quality(finished_ball({brushed, {"material_metalness", 1}}), 64),
             gloss = error_of_usual_quality(finished_ball({brushed}), 64),
             glass = error_of_usual_quality(
                 finished_ball({frosted, {"material_transmission", 1}, {"material_thickness", 2}}), 64);
  EXPECT_LT(metal[0], 0.09);
  EXPECT_LT(gloss[0], 0.025);
  EXPECT_LT(glass[0], 0.045);
  for (const auto& [deviation, worst] : {metal, gloss, glass}) EXPECT_LT(worst, 0.08);
}

TEST(Picture, MaterialsHaveTheSameBitsForAnyNumberOfThreads) {
  const TriangleMesh mesh = finished_ball({{"material_roughness", 0.4}, {"material_transmission", 0.5}});
  std::vector<std::vector<float>> pictures;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    pictures.push_back(render(mesh, small()).rgb);
  }
  EXPECT_EQ(pictures[0], pictures[1]);
}

/// A green ball between a small red one and the key lamp, or beside that way.
TriangleMesh two_balls(bool in_the_way) {
  TriangleMesh mesh = ball(0, 0.5, 0);
  const TriangleMesh red = ball(0.5, 0, 0);
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  const double side = in_the_way ? -0.447 : 0.447;  // the lamp: -42 degrees, 48 above the floor
  for (Point& p : mesh.points) p = {p[0] + 1.8 * side, p[1] + 1.8 * 0.743, p[2] + 1.8 * 0.497};
  for (const Point& p : red.points) mesh.points.push_back({0.4 * p[0], 0.4 * p[1], 0.4 * p[2]});
  for (const Triangle& t : red.triangles) mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  for (std::size_t k = 0; k < mesh.attributes.size(); ++k)
    mesh.attributes[k].values.insert(mesh.attributes[k].values.end(), red.attributes[k].values.begin(),
                                     red.attributes[k].values.end());
  return mesh;
}

double brightness_of_red(const Image& image) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    if (image.rgb[i] > 2 * image.rgb[i + 1]) sum += static_cast<double>(image.rgb[i]), ++count;
  EXPECT_GT(count, 50);
  return sum / count;
}

TEST(Picture, OneThingShadesAnother) {
  PictureOptions options = small();
  options.azimuth = options.elevation = 0;
  const double shaded = brightness_of_red(render(two_balls(true), options)),
               lit = brightness_of_red(render(two_balls(false), options));
  EXPECT_LT(shaded, 0.6 * lit);
  EXPECT_GT(shaded, 0.1 * lit);
}

TEST(Picture, PlainBackdropIsTheStudios) {
  // Far from the ball there is no light but that in the open.
  PictureOptions options = small();
  const Image image = render(ball(0.5, 0.5, 0.5), options);
  for (int x : {0, 40, 95}) {
    const double px = (2 * x + 1) / 96.0 - 1, py = 1 - 1 / 96.0;
    const double fall = 0.16 * (px * px + py * py) + 0.05 * py;
    EXPECT_NEAR(static_cast<double>(image.rgb[static_cast<std::size_t>(3 * x)]), 0.8 * (1 - fall), 0.006 * 0.8);
  }
}

/// Balls whose noise docs/pictures.md tells.
std::vector<std::pair<const char*, TriangleMesh>> noisy_balls() {
  return {{"matt", ball(0.8, 0.6, 0.4)},
          {"gold", finished_ball({{"material_roughness", 0.25}, {"material_metalness", 1}})},
          {"glass",
           finished_ball({{"material_roughness", 0.02}, {"material_transmission", 1}, {"material_thickness", 2}})}};
}

PictureOptions noisy_picture(int size, int samples, bool denoise) {
  PictureOptions options;
  options.width = options.height = size;
  options.samples = samples, options.denoise = denoise, options.dither = false;
  return options;
}

/// How far a picture is from a converged one of the same size: the root mean square over the ball's middle and its
/// foot, all channels, in steps of 8-bit sRGB.
double noise(PictureScene& scene, const Image& exact, int samples, bool denoise) {
  const Image image = scene.render(noisy_picture(exact.width, samples, denoise));
  const auto step = [](float c) { return 255 * srgb_from_linear(std::clamp(static_cast<double>(c), 0.0, 1.0)); };
  double squares = 0;
  int count = 0;
  for (int y = 3 * image.height / 10; y < 9 * image.height / 10; ++y)
    for (int x = 3 * image.width / 10; x < 7 * image.width / 10; ++x)
      for (int k = 0; k < 3; ++k, ++count) {
        const auto i = static_cast<std::size_t>(3 * (y * image.width + x) + k);
        squares += std::pow(step(image.rgb[i]) - step(exact.rgb[i]), 2);
      }
  return std::sqrt(squares / count);
}

TEST(Noise, FallsWithTheRootOfTheSamplesAndIsWhatTheManualSays) {
  for (const auto& [name, mesh] : noisy_balls()) {
    PictureScene scene(mesh);
    const Image exact = scene.render(noisy_picture(64, 1024, false));
    const double few = noise(scene, exact, 8, false), many = noise(scene, exact, 128, false);
    EXPECT_GT(few, 0) << name;
    EXPECT_LT(many, few / 4 * 1.15) << name;  // sixteen times the samples
    EXPECT_LT(noise(scene, exact, PictureOptions().samples, true), 4) << name;
  }
}

/// Not a test: prints the table of docs/pictures.md.
TEST(Noise, DISABLED_Table) {
  for (const auto& [name, mesh] : noisy_balls()) {
    PictureScene scene(mesh);
    const Image exact = scene.render(noisy_picture(96, 2048, false));
    for (const int samples : {4, 8, 16, 32, 64, 128})
      std::printf("%s | %d | %.2f | %.2f\n", name, samples, noise(scene, exact, samples, false),
                  noise(scene, exact, samples, true));
  }
}

/// The width of what is red, pixels.
int red_width(const Image& image) {
  int left = image.width, right = -1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float* c = &image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
      if (c[0] < 2 * c[1]) continue;
      left = std::min(left, x), right = std::max(right, x);
    }
  return right - left + 1;
}

TEST(Picture, ABallIsAsWideAsTheLensSays) {
  for (const double millimetres : {20.0, 50.0, 135.0}) {
    PictureOptions options = small();
    options.width = 240, options.height = 160, options.samples = 4, options.ground = false;
    options.angle = angle_of_lens(millimetres);
    const double distance = millimetres / 8;  // from the middle; the outline lies on the cone that touches the ball
    options.camera = {{0, 0, distance}, {0, 0, -1}, {0, 1, 0}};
    const double outline = std::tan(std::asin(1 / distance));  // on the film, over the focal length
    EXPECT_NEAR(red_width(render(ball(1, 0, 0), options)), 2 * outline * millimetres / 36 * options.width, 3)
        << millimetres;
  }
}

TEST(Picture, CornersAreWhereAPlacedCameraProjectsThem) {
  // Small balls at the corners of a box, one red, seen by a camera that leans.
  const auto scene = [](std::size_t red) {
    TriangleMesh all;
    std::vector<double> colors;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const TriangleMesh one = builtin_shape("builtin:sphere?n=162");
      const auto base = static_cast<std::int32_t>(all.points.size());
      for (const Point& p : one.points) {
        all.points.push_back({0.05 * p[0] + (corner & 1 ? 2 : -2), 0.05 * p[1] + (corner & 2 ? 1 : -1),
                              0.05 * p[2] + (corner & 4 ? 1.5 : -1.5)});
        for (const double c : {1.0, corner == red ? 0.0 : 1.0, corner == red ? 0.0 : 1.0}) colors.push_back(c);
      }
      for (const Triangle& t : one.triangles) all.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
    all.attributes = {{"color", 3, Domain::vertex, colors}};
    return all;
  };
  PictureOptions options = small();
  options.width = 300, options.height = 200, options.ground = false, options.angle = 70;
  const Eigen::Vector3d position(3, 2, 5), towards = Eigen::Vector3d(-0.2, -0.1, 0.1) - position, up(0.3, 1, 0);
  options.camera = {{3, 2, 5}, {towards[0], towards[1], towards[2]}, {up[0], up[1], up[2]}};
  const Eigen::Vector3d back = -towards.normalized(), right = up.cross(back).normalized(), above = back.cross(right);
  const double scale = options.width / (2 * std::tan(35 * std::numbers::pi / 180));  // pixels
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const Image image = render(scene(corner), options);
    double x = 0, y = 0, count = 0;
    for (int j = 0; j < image.height; ++j)
      for (int i = 0; i < image.width; ++i) {
        const float* c = &image.rgb[static_cast<std::size_t>(3 * (j * image.width + i))];
        if (c[0] > 2 * c[1]) x += i + 0.5, y += j + 0.5, ++count;
      }
    const Eigen::Vector3d p(corner & 1 ? 2 : -2, corner & 2 ? 1 : -1, corner & 4 ? 1.5 : -1.5);
    const double depth = (position - p).dot(back);
    ASSERT_GT(count, 3) << corner;
    EXPECT_NEAR(x / count, options.width / 2.0 + scale * (p - position).dot(right) / depth, 1) << corner;
    EXPECT_NEAR(y / count, options.height / 2.0 - scale * (p - position).dot(above) / depth, 1) << corner;
  }
}

TEST(Picture, AFullTurnIsTheStart) {
  TriangleMesh mesh = builtin_shape("builtin:cube?n=200");
  PictureOptions options = small();
  options.steady = true;
  const Image start = render(mesh, options);
  options.azimuth += 360;
  const Image turned = render(mesh, options);
  double worst = 0;
  for (std::size_t i = 0; i < start.rgb.size(); ++i)
    worst = std::max<double>(worst, std::abs(start.rgb[i] - turned.rgb[i]));
  EXPECT_LT(worst, 0.05);  // rounding of the angle moves edges by millionths of a pixel
  options.azimuth -= 270;
  EXPECT_LT(std::abs(mean(render(mesh, options), 30, 30, 40, 1) - mean(start, 30, 30, 40, 1)), 0.01);  // a cube
}

TEST(Picture, WithoutGroundThereIsNoShadow) {
  PictureOptions options = small();
  options.dither = false;
  const auto darkest = [&] {
    const Image image = render(ball(0.5, 0.5, 0.5), options);
    float least = 1;
    for (int x = 0; x < image.width; ++x)
      least = std::min(least, image.rgb[static_cast<std::size_t>(3 * ((image.height - 2) * image.width + x))]);
    return least;
  };
  const float shaded = darkest();
  options.ground = false;
  EXPECT_GT(darkest(), 1.1F * shaded);
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
