#pragma once
// A scene is data only: things on a table, how they are lit and from where they are seen (docs/scenes.md).

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pelage/channel.h"
#include "pelage/point.h"
#include "pelage/recipe.h"

namespace pelage {

/// A copy of a thing: scaled, tilted around x, turned around the upright axis y, and moved.
struct ScenePlace {
  Point at{};
  double turn = 0, tilt = 0;  ///< degrees
  double scale = 1;
};

struct SceneThing {
  Given<std::string> shape;                       ///< as `pelage grow` takes it; or
  std::vector<std::array<double, 2>> turned;      ///< a profile: radius and height, from the axis to the axis
  std::optional<Given<std::string>> recipe_name;  ///< built in, or a file; or
  std::optional<Recipe> recipe;                   ///< in the scene itself; or neither:
  std::optional<Given<std::string>> color;        ///< all over
  std::map<Channel, double> material;             ///< likewise; lengths in units of the shape
  std::optional<Given<Length>> size;              ///< instead of the recipe's
  std::optional<std::uint64_t> seed;              ///< likewise
  bool framed = true;                             ///< whether the camera has to see all of it
  std::vector<ScenePlace> places;                 ///< at least one
  Location where;
};

struct SceneCamera {
  double azimuth = 35, elevation = 14, angle = 26;  ///< degrees; angle: that the longer side sees
  double margin = 0.09;                             ///< of the picture around what is framed; below 0 it is cut off
  double aspect = 1;                                ///< width over height
};

struct SceneLamp {
  double azimuth = -42, elevation = 48;  ///< degrees, to the right of the camera and above the floor
  double size = 0.3;                     ///< radius over distance
};

struct Scene {
  std::string name, summary;
  SceneCamera camera;
  SceneLamp lamp;
  std::optional<Given<std::string>> background;  ///< "#rrggbb"
  double exposure = 0;                           ///< stops
  std::vector<SceneThing> things;
};

/// Error(Fault::usage) with file and line for anything unknown, misspelt or out of its range.
Scene parse_scene(const std::string& text, const std::string& file);

}  // namespace pelage
