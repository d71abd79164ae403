#pragma once
// The smaller copies of a baked image that viewers show from afar (mip-maps), blurred on the surface and not in the
// image: from chart to chart, and across a seam, no colours come that the surface does not have there.

#include "look/bake.h"

namespace pelage {

/// Of the colours of each tile of that layout the levels 1, 2, ..., down to one texel; level k has size >> k texels
/// along a side. Where its texels are shorter than the edges of the tessellation it is baked like level 0; a coarser
/// one has the colours of the tessellation, in linear light, blurred by a Gaussian whose sigma is half a texel's
/// middling length on the surface: twice as large from level to level. Between charts is the mean of the surface.
/// `shape`: that of the sampler, with "uv". Errors of SurfaceBlur.
std::vector<std::vector<Pixels>> mip_levels(const CoatSampler& coat, const Palette& palette, const TriangleMesh& shape,
                                            const UvLayout& layout);

}  // namespace pelage
