#pragma once
// Shapes whose nodes are what they are: a pattern lives on them without any refinement.

#include <memory>
#include <variant>

#include "pelage/atlas.h"
#include "pelage/cells.h"
#include "pelage/grid.h"
#include "pelage/tet_mesh.h"

namespace pelage {

using NodeShape = std::variant<Grid, Atlas, Cells, TetMesh>;

/// The shape, if it is of that kind, else null. `shape` may be null.
template <class Kind>
const Kind* as(const std::shared_ptr<const NodeShape>& shape) {
  return shape ? std::get_if<Kind>(shape.get()) : nullptr;
}

}  // namespace pelage
