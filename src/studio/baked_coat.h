#pragma once
// A coat as images on its shape, for a file.

#include "discretise/coat_fields.h"
#include "look/palette.h"
#include "pelage/io.h"
#include "pelage/progress.h"

namespace pelage {

/// The bytes of a GLB: the shape as it was given with the coat as square images of so many texels a side, on its own uv
/// or else on an atlas that is made for it. Error(Fault::usage) for shapes that are no surfaces and uv of several
/// images.
std::string baked_glb(CoatFields fields, const Look& look, int size, const SaveOptions& options,
                      const Progress& progress);

}  // namespace pelage
