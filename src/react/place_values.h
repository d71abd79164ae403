#pragma once
// The quantities that a formula reads from the place: coordinates, normals, curvatures, attributes, random fields.

#include <cstdint>
#include <vector>

#include "react/expression.h"
#include "react/kinetics.h"

namespace pelage {

/// The values of a place symbol at all samples. Random fields depend on (seed, stream, place from
/// the origin in length units) alone. Error(usage)
/// located where the formula uses the symbol if the places do not have it.
std::vector<double> place_values(const Symbol& symbol, const Places& places, std::uint64_t seed);

/// Those of the symbols that are random.
std::vector<DrawnField> draw_random_fields(const std::vector<Symbol>& symbols, const Places& places,
                                           std::uint64_t seed);

/// Values at all places of expressions that depend on the place alone. Small integer powers should have been written as
/// products (expand_powers).
std::vector<std::vector<double>> evaluate_places(const Graph& graph, const std::vector<NodeId>& expressions,
                                                 const Places& places, std::uint64_t seed);
/// The same for one, whose powers are expanded: one value per place, or one for all.
std::vector<double> evaluate_place(Graph& graph, NodeId expression, const Places& places, std::uint64_t seed);

/// The quantities of the place that an expression reads, in the order of their nodes.
std::vector<Symbol> place_symbols(const Graph& graph, const std::vector<NodeId>& expressions);

/// Error(usage), located, for an attribute that is not among the names; matching_name says which of them it is.
void require_attribute(const Symbol& symbol, const std::vector<std::string>& names);

/// The quantities of the place that a model reads.
std::vector<Symbol> place_symbols(const Model& model);

}  // namespace pelage
