#pragma once
// From scenes to what can be drawn.

#include <string>
#include <vector>

#include "pelage/progress.h"
#include "pelage/triangle_mesh.h"
#include "recipe/scene.h"

namespace pelage {

/// The scenes that are compiled in.
std::vector<std::string> scene_names();
/// The built-in scene of that name, or the one in the file when the name ends in .toml. Errors as load_recipe().
Scene load_scene(const std::string& name_or_path);

/// All things of a scene in their places, y up.
struct BuiltScene {
  TriangleMesh mesh;          ///< with normals, colours and materials at the vertices
  std::vector<Point> framed;  ///< what the camera has to see
};

/// Grows the coats. `quality`: instead of that of the recipes, unless empty. `progress` is told of things by their
/// numbers. Errors as those of find_shape() and Growth, located in the scene where a name is unknown.
BuiltScene build_scene(const Scene& scene, const std::string& quality, const Progress& progress);

}  // namespace pelage
