#pragma once
// Coats on sewn patches as images: one for each patch, all in one, and where they lie on the mesh.
//
// The outermost texels of a patch have their middles on its sides. Sides that are sewn have the same nodes and so the
// same texels: both images hold the same colours there, and between the middles of texels nothing is interpolated that
// is not the patch's own.

#include <vector>

#include "discretise/coat_fields.h"
#include "pelage/image.h"
#include "pelage/recipe.h"

namespace pelage {

/// Where the images of patches lie in a square one.
struct PatchLayout {
  /// Its first texel, without the gutter, from the top left corner.
  struct Chart {
    int x = 0, y = 0, width = 0, height = 0;
  };
  int size = 0;               ///< of the square [texels]
  int gutter = 0;             ///< around each chart, that filters and smaller copies of the image find no other colours
  std::vector<Chart> charts;  ///< of every patch
};

/// As many texels for the edge of a cell as `size` has room for, the same everywhere. Error(Fault::usage) where that is
/// less than one, with a size that would do.
PatchLayout lay_out(const Atlas& atlas, int size);

/// "uv" at the corners of mesh_of(atlas): u to the right along the first axis of each patch, v upwards.
Attribute patch_uv(const Atlas& atlas, const PatchLayout& layout);

/// The images of all patches, with v upwards: fields are linear along both axes of a cell, and painted at every texel.
/// The ends of ramps are those of dress(). Errors of dress(); the coat is one of an atlas.
std::vector<Image> patch_images(const CoatFields& fields, const Look& look, const PatchLayout& layout);

/// All of them; each is continued into its gutter, and their mean is between.
Image joined(const std::vector<Image>& patches, const PatchLayout& layout);

}  // namespace pelage
