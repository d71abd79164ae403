#pragma once
// The direction field of a stage with anisotropic diffusion.

#include <optional>
#include <string>

#include "direction/guides.h"
#include "discretise/anisotropy.h"
#include "discretise/space.h"
#include "pelage/node_shape.h"
#include "shape/topology.h"

namespace pelage {

/// Lines d d' at the vertices of the shape: those of the wish; or else those that the shape brings along, as a vector
/// "direction" per vertex or three numbers "direction_1", "_2", "_3", or "_0", "_1", "_2", or "_x", "_y", "_z", in any
/// case; or else its smoothest field of lines. A vertex whose vector is 0, not finite or along the normal wishes
/// nothing: there the field is the smoothest one between the others. Error(Fault::input) for a "direction" of other
/// components; errors of direction_field.
std::vector<Tensor> vertex_lines(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                                 const Topology& topology);

/// The same at nodes that are what they are, whose mesh is `shape` and space `space`: on a grid without a wish and
/// "direction" its first axis, in a volume without any x; an axis or a centre alone is followed as it is, without
/// smoothing, but for cells, which are a surface. In blocks and volumes all components count, and across a line is a
/// plane (see wished_in_space). One tensor where it is the same for all nodes. Error(Fault::usage) for wishes that only
/// surfaces grant where it is none.
std::vector<Tensor> node_lines(const NodeShape& nodes, const Space& space, const TriangleMesh& shape,
                               const std::optional<FieldWish>& wish);

/// What vertex_lines or, with nodes, node_lines follows, a line for people each.
struct FollowedDirections {
  std::string text;     ///< "direction_x, direction_y, direction_z of the shape", ...
  std::string warning;  ///< of directions of the shape that say nothing; or empty
};
FollowedDirections followed_directions(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                                       const NodeShape* nodes = nullptr);

/// All attributes of a shape that hold directions or a component of them.
std::vector<std::string> direction_attributes(const TriangleMesh& shape);

}  // namespace pelage
