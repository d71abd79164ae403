#pragma once
// How accurate a coat is to be: what a name asks of the mesh, of the steps and of the picture.

#include <span>
#include <string_view>

namespace pelage {

struct Quality {
  std::string_view name;
  std::string_view summary;  ///< some words
  double edges;              ///< factor on the edges per wavelength
  double step_error;         ///< factor on the local error of an adaptive step
  int picture_samples;       ///< rays per pixel at the edges of a picture
};

/// From fast to accurate.
std::span<const Quality> qualities();

}  // namespace pelage
