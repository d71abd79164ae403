#include "io/gltf_camera.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pelage/error.h"

namespace pelage {
namespace {

GltfCamera camera_of(const std::string& members) {
  const std::string path = ::testing::TempDir() + "camera.gltf";
  std::ofstream(path) << R"({"asset":{"version":"2.0"},)" << members << "}";
  return read_gltf_camera(path);
}

void expect_near(const Point& p, const Point& q) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p[k], q[k], 1e-9) << k;
}

// A quarter turn to the left around y, below a node that moves and doubles: by hand.
constexpr const char* nested = R"("nodes":[{"children":[1],"translation":[1,2,3],"scale":[2,2,2]},
  {"camera":1,"translation":[0,0,5],"rotation":[0,0.70710678118654752,0,0.70710678118654752]}],
  "cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":1,"znear":0}},
  {"type":"perspective","perspective":{"yfov":1.5707963267948966,"znear":0.1,"aspectRatio":1.5}}])";

TEST(GltfCamera, StandsWhereItsNodesPutIt) {
  const GltfCamera camera = camera_of(nested);
  expect_near(camera.position, {1, 2, 13});
  expect_near(camera.towards, {-1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  EXPECT_NEAR(camera.angle, 90, 1e-9);
  EXPECT_EQ(camera.aspect, 1.5);
}

TEST(GltfCamera, OnlyThoseOfTheSceneCount) {
  const std::string text = nested;
  EXPECT_THROW(camera_of(text + R"(,"scenes":[{"nodes":[]}],"scene":0)"), Error);
  EXPECT_NO_THROW(camera_of(text + R"(,"scenes":[{"nodes":[0]}],"scene":0)"));
}

TEST(GltfCamera, RefusesFilesWithoutOne) {
  for (const char* members : {R"("nodes":[{}])", R"("nodes":[{"camera":3}],"cameras":[])",
                              R"("nodes":[{"camera":0}],"cameras":[{"perspective":{"yfov":7}}])"})
    try {
      camera_of(members);
      ADD_FAILURE() << members;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input) << members;
    }
}

}  // namespace
}  // namespace pelage
