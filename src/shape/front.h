#pragma once
// Guesses where the front of a shape is, so that animals are not seen from behind.

#include <optional>

#include "pelage/triangle_mesh.h"
#include "pelage/up_axis.h"

namespace pelage {

/// The direction in which a shape looks, in degrees around the axis that points up as in pictures: 0 to +z (or -y where
/// z points up), 90 to +x; or nothing where that is not plain. A shape that is its own mirror image at one upright
/// plane and at no other has a left and a right; on the line between, the head is at the end above which more is high
/// up. What stands there thin as a sheet has feet instead, which point ahead. The same for the shape turned, moved or
/// scaled, to within 5 degrees.
std::optional<double> front_of(const TriangleMesh& mesh, UpAxis up);

}  // namespace pelage
