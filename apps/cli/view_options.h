#pragma once
// How pictures look at a shape, on the command line: the same options for all commands that draw.

#include <optional>
#include <string>

#include "command.h"
#include "pelage/render.h"

namespace pelage {

/// What was given.
struct ViewOptions {
  std::optional<double> azimuth, elevation;  ///< degrees; --view sets the elevation
  std::optional<double> from_front;          ///< degrees from where the shape looks to, by --view
  std::optional<std::array<double, 3>> background;
  std::optional<UpAxis> up;  ///< or else what the file says
  double exposure = 0;
};

/// --view, --azimuth, --elevation, --exposure, --background and --up, in the command's plain list unless a group is
/// named.
void add_view_options(CLI::App& app, ViewOptions& options, const std::string& group = {});

/// A square picture of that size of a shape whose file says that `up` points up; unless the direction is given, from
/// before its front where that can be guessed (shape/front.h).
PictureOptions picture_options(const ViewOptions& view, int size, UpAxis up, const TriangleMesh& shape);

}  // namespace pelage
