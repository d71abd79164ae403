#pragma once
// How accurate a coat is to be: what a name asks of the mesh and of the steps.

#include <span>
#include <string_view>

namespace pelage {

struct Quality {
  std::string_view name;
  std::string_view summary;  ///< some words
  double edges;              ///< factor on the edges per wavelength
  double step_error;         ///< factor on the local error of an adaptive step
};

/// From fast to accurate.
std::span<const Quality> qualities();

}  // namespace pelage
