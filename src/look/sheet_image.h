#pragma once
// The coat of an even sheet as an image without a mesh in between, for sheets of many millions of nodes.

#include "discretise/coat_fields.h"
#include "pelage/image.h"
#include "pelage/recipe.h"

namespace pelage {

/// Whether the fields live on an even sheet that has nothing else to be painted with: no attributes, no textures.
bool is_bare_sheet(const CoatFields& fields);

/// The pixels that grid_image makes of what dress() makes of such a sheet, painted some rows at a time. Errors as those
/// of dress().
Image sheet_image(const CoatFields& fields, const Look& look);

}  // namespace pelage
