#pragma once
// What the equations say before anything is run: steady states, growth rates, and the size of the pattern.

#include <vector>

#include "pelage/stability.h"
#include "react/model.h"

namespace pelage {

/// Analyses a model; the steady states are those that Newton's method reaches from some hundred starts. When there is
/// none, `steady_states` and all else stay empty.
Stability analyse(const Model& model);

/// The same about one given steady state, which is the only one in `steady_states`.
Stability analyse_at(const Model& model, const std::vector<double>& steady_state);

}  // namespace pelage
