#pragma once
// A coat as images on its shape.

#include <cstddef>

#include "discretise/coat_fields.h"
#include "look/palette.h"
#include "pelage/grow.h"

namespace pelage {

/// The shape with the atlas that pelage unwrap makes for images of that size, and how many charts it has.
struct AtlasShape {
  ShapeFile file;
  std::size_t charts = 0;
};
AtlasShape with_atlas(ShapeFile file, int size, const Progress& progress);

/// What viewers shade: the file's own mesh as it is cut into triangles; where repairs have changed those, the one of
/// the run.
TriangleMesh shaded_mesh(const PolygonMesh& mesh, const TriangleMesh& shape);

/// The shape as it was given with the coat as square images of so many texels a side, on its own uv or else on an atlas
/// that is made for it. `file`: what the shape was read from; its mesh is that of the fields. Error(Fault::usage) for
/// shapes that are no surfaces and uv of several images.
TexturedMesh textured_coat(CoatFields fields, ShapeFile file, const Look& look, int size, const Progress& progress);

}  // namespace pelage
