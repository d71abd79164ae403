#include <pelage/field.h>
#include <pelage/io.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "api_support.h"

namespace pelage::api {
namespace {

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

int index_sum(const SurfaceField& field) {
  int sum = 0;
  for (const Singularity& s : field.singularities) {
    EXPECT_NE(s.index, 0);
    sum += s.index;
  }
  return sum;
}

TEST(Field, IndicesAddUpToTheEulerCharacteristic) {
  const std::pair<const char*, int> shapes[] = {{"builtin:sphere?n=642", 2}, {"builtin:torus?n=600", 0}};
  for (const auto& [shape, euler] : shapes) {
    const FieldMaker maker(load_shape(shape));
    for (const int n : {1, 2, 4}) {
      FieldOptions options;
      options.n = n;
      EXPECT_EQ(index_sum(maker.make(options)), n * euler) << shape << ", n = " << n;
    }
  }
}

TEST(Field, DirectionsAreUnitTangents) {
  const TriangleMesh sphere = load_shape("builtin:sphere?n=642");
  const SurfaceField field = surface_field(sphere);
  ASSERT_EQ(field.direction.size(), sphere.points.size());
  EXPECT_EQ(field.n, 2);
  EXPECT_GT(field.roughness, 0);
  for (std::size_t v = 0; v < sphere.points.size(); ++v) {
    EXPECT_NEAR(dot(field.direction[v], field.direction[v]), 1, 1e-12);
    const double radius = std::sqrt(dot(sphere.points[v], sphere.points[v]));
    EXPECT_NEAR(dot(field.direction[v], sphere.points[v]) / radius, 0, 0.02);
  }
}

/// The cosine of the angle between the field and the projection of the z axis, at most, and at least, far from the
/// poles.
std::pair<double, double> cosines_to_axis(const TriangleMesh& sphere, const SurfaceField& field) {
  double low = 1, high = 0;
  for (std::size_t v = 0; v < sphere.points.size(); ++v) {
    const double radius = std::sqrt(dot(sphere.points[v], sphere.points[v]));
    const double z = sphere.points[v][2] / radius;
    if (std::abs(z) > 0.8) continue;
    const double cosine = std::abs(field.direction[v][2]) / std::sqrt(1 - z * z);
    low = std::min(low, cosine);
    high = std::max(high, cosine);
  }
  return {low, high};
}

TEST(Field, FollowsAnAxisOrRunsAcross) {
  const TriangleMesh sphere = load_shape("builtin:sphere?n=642");
  const FieldMaker maker(sphere);
  FieldOptions options;
  options.axis = Point{0, 0, 3};
  EXPECT_GT(cosines_to_axis(sphere, maker.make(options)).first, 0.99);
  options.across = true;
  EXPECT_LT(cosines_to_axis(sphere, maker.make(options)).second, 0.15);
}

TEST(Field, FollowsAStroke) {
  const TriangleMesh sphere = load_shape("builtin:sphere?n=642");
  const double radius = std::sqrt(dot(sphere.points[0], sphere.points[0]));
  FieldOptions options;
  for (const double direction : {0.0, 1.0}) {
    const Point along{0, 1 - direction, direction};  // through the point (radius, 0, 0)
    options.strokes = {{{radius, -0.3 * radius * along[1], -0.3 * radius * along[2]},
                        {radius, 0.3 * radius * along[1], 0.3 * radius * along[2]}}};
    const SurfaceField field = surface_field(sphere, options);
    std::size_t nearest = 0;
    for (std::size_t v = 0; v < sphere.points.size(); ++v)
      if (sphere.points[v][0] > sphere.points[nearest][0]) nearest = v;
    EXPECT_GT(std::abs(dot(field.direction[nearest], along)), 0.97);
  }
}

TEST(Field, CurvatureLeadsAroundATorus) {
  const TriangleMesh torus = load_shape("builtin:torus?n=1200");
  FieldOptions options;
  options.curvature = true;
  const SurfaceField field = surface_field(torus, options);
  EXPECT_TRUE(field.singularities.empty());
}

TEST(Field, TheFunctionIsTheObject) {
  const TriangleMesh animal = load_shape("builtin:animal?n=600");
  FieldOptions options;
  options.from = {0};
  options.to = {200};
  options.n = 1;
  const FieldMaker maker(animal);
  maker.make();
  const SurfaceField one = surface_field(animal, options), two = maker.make(options);
  EXPECT_EQ(one.direction, two.direction);
  EXPECT_EQ(one.singularities.size(), two.singularities.size());
  const TriangleMesh marked = with_directions(animal, one.direction);
  const Attribute* attribute = marked.find("direction");
  ASSERT_NE(attribute, nullptr);
  ASSERT_EQ(attribute->values.size(), 3 * animal.points.size());
  for (std::size_t i = 0; i < attribute->values.size(); ++i)
    EXPECT_EQ(attribute->values[i], one.direction[i / 3][i % 3]);
}

TEST(Field, FaultsAreRefused) {
  const FieldMaker maker(load_shape("builtin:sphere?n=162"));
  const auto fault = [&](auto&& change) {
    FieldOptions options;
    change(options);
    return fault_of([&] { maker.make(options); });
  };
  EXPECT_EQ(fault([](FieldOptions& o) { o.n = 3; }), 2);
  EXPECT_EQ(fault([](FieldOptions& o) { o.smooth = -1; }), 2);
  EXPECT_EQ(fault([](FieldOptions& o) { o.smooth = std::numeric_limits<double>::quiet_NaN(); }), 2);
  EXPECT_EQ(fault([](FieldOptions& o) { o.axis = Point{0, 0, 0}; }), 2);
  EXPECT_EQ(fault([](FieldOptions& o) { o.from = {0}; }), 2);
  EXPECT_EQ(fault([](FieldOptions& o) { o.from = {0}, o.to = {100000}; }), 2);
  EXPECT_EQ(fault([](FieldOptions& o) { o.strokes = {{{1, 0, 0}}}; }), 2);
}

}  // namespace
}  // namespace pelage::api
