#include <pelage/io.h>
#include <pelage/render.h>

#include "api_support.h"

namespace pelage::api {
namespace {

PictureOptions small() {
  PictureOptions options;
  options.width = 40;
  options.height = 30;
  options.samples = 4;
  return options;
}

TEST(Render, ASceneGivesThePicturesOfTheFunction) {
  const TriangleMesh mesh = load_shape("builtin:animal?n=600");
  PictureScene scene(mesh);
  PictureOptions options = small();
  std::vector<std::vector<float>> seen;
  for (const UpAxis up : {UpAxis::y, UpAxis::z, UpAxis::y})
    for (const double azimuth : {0, 90}) {
      options.up = up;
      options.azimuth = azimuth;
      const Image image = scene.render(options);
      EXPECT_EQ(image.width, 40);
      EXPECT_EQ(image.height, 30);
      EXPECT_EQ(image.rgb, render(mesh, options).rgb);
      seen.push_back(image.rgb);
    }
  EXPECT_NE(seen[0], seen[1]);
  EXPECT_NE(seen[0], seen[2]);
  EXPECT_EQ(seen[0], seen[4]);
}

TEST(Render, FaultsAndCancelling) {
  PictureScene scene(load_shape("builtin:sphere?n=162"));
  PictureOptions options = small();
  options.width = 0;
  EXPECT_EQ(fault_of([&] { scene.render(options); }), 2);
  EXPECT_EQ(fault_of([&] { scene.render(small(), [](std::string_view, double) { return false; }); }), 130);
  EXPECT_EQ(scene.render(small()).rgb, render(load_shape("builtin:sphere?n=162"), small()).rgb);
  EXPECT_EQ(fault_of([] { render(TriangleMesh{}, small()); }), 3);
}

}  // namespace
}  // namespace pelage::api
