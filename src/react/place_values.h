#pragma once
// The quantities that a formula reads from the place: coordinates, normals, curvatures, attributes, random fields.

#include <cstdint>
#include <vector>

#include "react/expression.h"
#include "react/kinetics.h"

namespace pelage {

/// The values of a place symbol at all samples. Random fields depend on (seed, stream, place) alone. Error(usage)
/// located where the formula uses the symbol if the places do not have it.
std::vector<double> place_values(const Symbol& symbol, const Places& places, std::uint64_t seed);

/// The quantities of the place that a model reads.
std::vector<Symbol> place_symbols(const Model& model);

}  // namespace pelage
