#pragma once
// Clouds of points as something that can be seen.

#include "pelage/triangle_mesh.h"

namespace pelage {

/// A flat disc for every point of a cloud, across its attribute "normal" and about as wide as the way to the points
/// around it, with the point's attributes at its corners. Discs without a normal face up.
TriangleMesh discs_of(const TriangleMesh& cloud);

}  // namespace pelage
