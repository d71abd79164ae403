#pragma once
// How pictures look at a shape, on the command line: the same options for all commands that draw.

#include <optional>
#include <string>

#include "command.h"
#include "io/gltf_camera.h"
#include "pelage/render.h"

namespace pelage {

/// What was given.
struct ViewOptions {
  std::optional<double> azimuth, elevation;  ///< degrees; --view sets the elevation
  std::optional<double> from_front;          ///< degrees from where the shape looks to, by --view
  std::optional<std::array<double, 3>> background;
  std::optional<UpAxis> up;           ///< or else what the file says
  std::optional<double> lens;         ///< focal length, mm of 35 mm film
  std::optional<std::string> camera;  ///< the glTF file with one
  std::optional<int> turntable;       ///< so many pictures around the shape
  bool no_ground = false;
  double exposure = 0;
};

/// --view, --azimuth, --elevation, --focal-length, --camera, --exposure, --background, --no-ground and --up, in the
/// command's plain list unless a group is named.
void add_view_options(CLI::App& app, ViewOptions& options, const std::string& group = {});

/// --turntable, for commands that make one picture. After add_view_options.
void add_turntable_option(CLI::App& app, ViewOptions& options, const std::string& group = {});

/// Width and height for an aspect, width over height.
void set_proportions(PictureOptions& picture, int longer_side, double aspect);

/// A picture of that size of a shape whose file says that `up` points up: square, but for cameras that say otherwise.
/// Unless the direction is given, it is taken from before the shape's front where that can be guessed (shape/front.h).
PictureOptions picture_options(const ViewOptions& view, int size, UpAxis up, const TriangleMesh& shape);

}  // namespace pelage
