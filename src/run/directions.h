#pragma once
// The direction field of a stage with anisotropic diffusion.

#include <optional>

#include "direction/guides.h"
#include "discretise/anisotropy.h"
#include "shape/topology.h"

namespace pelage {

/// Lines d d' at the vertices of the shape: those of the wish, or else of its attribute "direction", or else of its
/// smoothest field of lines. Error(Fault::input) for an attribute of another size.
std::vector<Tensor> vertex_lines(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                                 const Topology& topology);

}  // namespace pelage
