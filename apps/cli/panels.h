#pragma once
// The four panels of Fig. 1 of Bajaj, Zhang, Xu 2008 from one noisy shape.

#include <array>
#include <cstdint>

#include "pelage/recipe.h"
#include "pelage/render.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// Width and height of four panels of so many pixels across.
std::array<std::int64_t, 2> size_of_panels(int picture);

/// Side by side: the noisy shape, the faired one, the pattern of the recipe grown on the noisy shape, and `coupled`,
/// the coat that grew while the shape was faired. Every panel in the size of `picture`. The third is grown here.
/// Error(Fault::numerics) when that fails, Error(Fault::cancelled).
Image four_panels(const Recipe& recipe, const TriangleMesh& noisy, const TriangleMesh& coupled,
                  const PictureOptions& picture, const Progress& progress);

}  // namespace pelage
