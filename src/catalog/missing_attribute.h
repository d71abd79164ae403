#pragma once
// The fault of a formula that reads an attribute which the shape does not have.

#include <string>
#include <vector>

#include "pelage/error.h"
#include "pelage/triangle_mesh.h"
#include "react/expression.h"

namespace pelage {

/// Error(Fault::usage), located, that says what the name may have meant, what there is (`known`: all that formulas may
/// read) and why the attribute may not have come along.
Error missing_attribute(const Symbol& symbol, const TriangleMesh& shape, const std::vector<std::string>& known);

}  // namespace pelage
