#pragma once
// One coat among many: grown and drawn at once, for sheets and galleries.

#include <functional>
#include <optional>

#include "pelage/io.h"
#include "pelage/recipe.h"
#include "view_options.h"

namespace pelage {

struct TilePicture {
  Image image;          ///< empty where it was asked to stop
  std::string uniform;  ///< why there is no pattern, where there is none
};

/// A recipe on a shape, `size` pixels wide; `report` is told the fraction that is done, and answers whether to go on.
/// Errors of growing and drawing.
TilePicture tile_picture(const Recipe& recipe, ShapeFile shape, const ViewOptions& view, int size,
                         const std::function<bool(double)>& report);

/// A picture as bytes, and the other way round; nothing where they are no picture.
std::string bytes_of(const TilePicture& tile);
std::optional<TilePicture> tile_of(std::string_view bytes);

}  // namespace pelage
