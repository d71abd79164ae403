#pragma once
// A coat on the mesh that it was grown from, in the form of its file.

#include "look/palette.h"
#include "pelage/polygon_mesh.h"

namespace pelage {

/// The form of a mesh that has no other.
SourceShape own_form(const TriangleMesh& mesh);

/// The file's own mesh and attributes with what the coat adds to them; the first vertices of the coat are those of the
/// mesh that the file became.
PolygonMesh kept_shape(SourceShape source, const TriangleMesh& coat, const Paint& paint);

}  // namespace pelage
