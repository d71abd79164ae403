#include "io/gltf_camera.h"

#include <numbers>

#include "io/file_bytes.h"
#include "io/gltf_scene.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Cameras look along -z of their node, with y up; its scale does not count.
GltfCamera camera_at(const GltfMatrix& world) {
  GltfCamera camera{};
  camera.position = transformed(world, {0, 0, 0});
  camera.towards = unit(turned(world, {0, 0, -1}));
  camera.up = unit(turned(world, {0, 1, 0}));
  return camera;
}

}  // namespace

GltfCamera read_gltf_camera(const std::string& path) {
  const std::string bytes = read_file(path);
  const GltfDocument document(bytes, path);
  const GltfScene scene(document);
  std::vector<Finding> left_out;
  for (const std::size_t node : scene.shown(left_out, "camera")) {
    const std::size_t index = document.index(document.get("nodes", node), "camera").value_or(0);
    const GltfJson* lens = document.find(document.get("cameras", index), "perspective");
    if (!lens) continue;
    GltfCamera camera = camera_at(scene.world(node));
    const double angle = document.number(*lens, "yfov", 0), aspect = document.number(*lens, "aspectRatio", 0);
    if (!(angle > 0 && angle < std::numbers::pi) || !(aspect >= 0))
      document.fail(document.label("cameras", index) + " has no yfov between 0 and pi, or an aspectRatio below 0");
    camera.angle = angle * 180 / std::numbers::pi;
    if (aspect > 0) camera.aspect = aspect;
    return camera;
  }
  document.fail("no perspective camera stands in the scene; add one, or give --azimuth and --elevation");
}

}  // namespace pelage
