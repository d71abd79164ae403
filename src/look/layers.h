#pragma once
// Layers of paint over the colours of a field.

#include <string>
#include <vector>

#include "pelage/recipe.h"
#include "react/kinetics.h"

namespace pelage {

/// Paints the layers over `colors` (3 per sample, linear light), each with its opacity. Formulas read the places; those
/// attributes of them that `species` names are also known by name alone. Error(usage), located, for faults in formulas
/// and for unknown colours and ramps; without samples that is all that it does.
void paint(const std::vector<Layer>& layers, const std::vector<std::string>& species, const Places& places,
           std::vector<double>& colors);

}  // namespace pelage
