#pragma once
// Long work comes in slices; between two slices the caller reports and asks whether to go on.

#include <functional>
#include <string_view>

namespace pelage {

/// Called with what is being done and the fraction done in [0, 1] (negative: unknown).
/// Returning false asks the work to stop; it then throws Error(Fault::cancelled).
using Progress = std::function<bool(std::string_view what, double fraction)>;

}  // namespace pelage
