#pragma once
// The model of a stage over two of its parameters: what linear theory says of each pair, and what grows there.

#include "pelage/progress.h"
#include "pelage/recipe.h"
#include "run/parameter_map.h"
#include "studio/message.h"

namespace pelage {

/// Regime, growth and wavelength of every pair, x fastest; pairs outside of the ranges of the parameters have none.
/// Error(Fault::usage) for a stage or a parameter that is not there.
Message parameter_map(const Recipe& recipe, std::size_t stage, const MapAxis& x, const MapAxis& y);

/// A flat square on which the model has grown with these two parameters, as a picture of `texels` a side in the colours
/// of the model. Errors of run_map().
Message map_tile(const Recipe& recipe, std::size_t stage, const MapAxis& x, const MapAxis& y, std::size_t texels,
                 const Progress& progress);

}  // namespace pelage
