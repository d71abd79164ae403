// Growth at its nodes: values in and out, rates of one's own, images, the form of a file.
#include <pelage/grow.h>
#include <pelage/io.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "api_support.h"

namespace pelage::api {
namespace {

ShapeFile sphere() { return read_shape("builtin:sphere?n=162"); }

Recipe recipe(const std::string& more) { return parse_recipe("[stage]\nsize = 0.4\n" + more, "test"); }
Recipe turing(const std::string& more) { return recipe("model = \"turing\"\n" + more); }

TEST(Nodes, TakeValuesBack) {
  for (const char* method : {"remeshed", "loop", "linear"}) {
    Growth growth(sphere(), turing("method = \"" + std::string(method) + "\"\n"));
    const TriangleMesh nodes = growth.nodes();
    std::vector<double> wanted;
    for (const Point& p : nodes.points) wanted.push_back(4 + 0.1 * p[2]);
    growth.set_values("b", wanted);
    const std::vector<double> values = growth.values("b");
    ASSERT_EQ(values.size(), wanted.size()) << method;
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], wanted[i], 1e-9) << method;
    growth.advance(3);
    EXPECT_NE(growth.values("b"), values);
  }
}

TEST(Nodes, RefuseWhatIsNone) {
  Growth growth(sphere(), turing(""));
  const std::size_t count = growth.values("b").size();
  EXPECT_EQ(fault_of([&] { growth.values("c"); }), static_cast<int>(Fault::usage));
  EXPECT_EQ(fault_of([&] { growth.set_values("b", {1, 2}); }), static_cast<int>(Fault::usage));
  EXPECT_EQ(fault_of([&] { growth.set_values("b", std::vector<double>(count, NAN)); }), static_cast<int>(Fault::usage));
}

OwnRates schnakenberg(std::atomic<std::size_t>* calls = nullptr) {
  OwnRates own;
  own.rates = [calls](auto u, double, std::size_t begin, std::size_t end, auto rate) {
    if (calls) ++*calls;
    for (std::size_t s = 0; s < end - begin; ++s) {  // in the order of the model: v, u
      const double reaction = u[1][s] * u[1][s] * u[0][s];
      rate[0][s] = 0.9 - reaction;
      rate[1][s] = 0.1 - u[1][s] + reaction;
    }
  };
  return own;
}

TEST(OwnRates, TakeThePlaceOfFormulas) {
  const std::string text = "model = \"schnakenberg\"\nstepper = \"sbdf2\"\nstep = 0.05\nsteps = 200\n";
  std::atomic<std::size_t> calls = 0;
  Growth formulas(sphere(), recipe(text)), own(sphere(), recipe(text), {}, schnakenberg(&calls));
  formulas.advance(200);
  own.advance(200);
  EXPECT_GT(calls, 0u);
  const std::vector<double> a = formulas.values("u"), b = own.values("u");
  const double largest = *std::ranges::max_element(a);
  EXPECT_GT(largest - *std::ranges::min_element(a), 0.05);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12 * largest);
}

TEST(OwnRates, AreThoseOfAStageThatIsThere) {
  OwnRates own = schnakenberg();
  own.stage = "other";
  EXPECT_EQ(fault_of([&] { Growth(sphere(), recipe("model = \"schnakenberg\"\n"), {}, own); }),
            static_cast<int>(Fault::usage));
  const std::string split = "model = \"schnakenberg\"\nstepper = \"semi-implicit\"\n";
  EXPECT_EQ(fault_of([&] { Growth(sphere(), recipe(split), {}, schnakenberg()); }), static_cast<int>(Fault::usage));
}

TEST(Nodes, ImagesShowTheCoat) {
  Growth growth(sphere(), turing("steps = 20\n[look]\nspecies = \"b\"\n"));
  growth.advance(20);
  const TexturedMesh baked = growth.bake(64);
  ASSERT_TRUE(baked.maps.color);
  EXPECT_EQ(baked.maps.color->bytes.size(), 3u * 64 * 64);
  EXPECT_EQ(baked.height.size(), 64u * 64);
  EXPECT_EQ(baked.mesh.face_count(), sphere().mesh.triangles.size());
  const std::vector<double> b = growth.values("b");
  const auto [low, high] = std::ranges::minmax(baked.height);
  EXPECT_NEAR(low, *std::ranges::min_element(b), 0.05);
  EXPECT_NEAR(high, *std::ranges::max_element(b), 0.05);
  EXPECT_EQ(fault_of([&] { growth.bake(3); }), static_cast<int>(Fault::usage));
}

TEST(Nodes, AKeptShapeHasItsOwnVertices) {
  Growth growth(sphere(), turing("steps = 3\n[look]\nkeep-shape = true\n"));
  growth.advance(3);
  const TriangleMesh coat = growth.dress();
  EXPECT_EQ(coat.points, sphere().mesh.points);
  EXPECT_EQ(coat.triangles, sphere().mesh.triangles);
  EXPECT_EQ(growth.dress_in_file().points, coat.points);
}

TEST(CheckShape, OfPolygons) {
  PolygonMesh cube;
  for (int i = 0; i < 8; ++i) cube.points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  for (const auto& face :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    cube.corners.insert(cube.corners.end(), face.begin(), face.end());
    cube.end_face();
  }
  const ShapeFile shape = check_shape(cube);
  EXPECT_EQ(shape.mesh.triangles.size(), 12u);
  EXPECT_EQ(as_in_file(*shape.source, shape.mesh).face_count(), 6u);
  PolygonMesh lost = cube;
  lost.corners[5] = 8;
  EXPECT_EQ(fault_of([&] { check_shape(lost); }), static_cast<int>(Fault::input));
  PolygonMesh torn = cube;
  torn.face_ends.pop_back();
  EXPECT_EQ(fault_of([&] { check_shape(torn); }), static_cast<int>(Fault::input));
  PolygonMesh uneven = cube;
  uneven.set({"heat", 1, Domain::vertex, {1, 2, 3}});
  EXPECT_EQ(fault_of([&] { check_shape(uneven); }), static_cast<int>(Fault::input));
}

}  // namespace
}  // namespace pelage::api
