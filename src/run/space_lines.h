#pragma once
// Direction fields in blocks and volumes.

#include <optional>
#include <vector>

#include "direction/guides.h"
#include "discretise/space.h"

namespace pelage {

/// What a wish asks for at the nodes of a space of three dimensions: lines d d', or across them planes 1 - d d'. An
/// axis, a centre and the way between marks count alike; strokes count with the fourth power of their nearness, and
/// alone from nearer than `wish.smooth`. Error(Fault::usage) for principal curvatures, for strokes with `across`, and
/// for marks that are none.
std::vector<Tensor> wished_in_space(const Space& space, const std::vector<Point>& nodes, const FieldWish& wish);

/// Lines along vectors at the nodes; where these are 0 the smoothest tensors between the others, or all along x.
std::vector<Tensor> given_in_space(const Space& space, const std::vector<Point>& vectors);

}  // namespace pelage
