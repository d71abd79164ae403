#pragma once
// Where the directions of stripes are none.

#include <Eigen/Core>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// By how much a field of lines turns around each triangle, in half turns: 1 where three stripes' worth of directions
/// bend around an end (+1/2), -1 where three directions meet (-1/2), 0 elsewhere. `tensors` as of slope_tensors, whose
/// main directions the lines are, `normals` along those of the surface at the vertices. Directions pass along edges by
/// the turn from normal to normal, so that the sum over a closed surface is twice its Euler characteristic.
std::vector<int> half_turns(const TriangleMesh& mesh, const std::vector<Eigen::Matrix3d>& tensors,
                            const std::vector<Eigen::Vector3d>& normals);

}  // namespace pelage
