#pragma once
// Volumes on even grids.

#include "pelage/grid.h"
#include "pelage/tet_mesh.h"

namespace pelage {

/// The attributes of a volume at the nodes of an even block around it, which are as near to each other as the nodes of
/// the volume (as many per volume; at most 2^26). Between nodes attributes are linear, with integers and names those of
/// the nearest corner. "inside" is 1 within the volume and 0 outside, where every node has the mean of those next to it
/// that lie nearer to the volume: a texture that is looked up between nodes shows no seam.
Grid sampled(const TetMesh& volume);

}  // namespace pelage
