#pragma once
// What an image says about a mesh, through the mesh's uv.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shape/scalar_attributes.h"

namespace pelage {

/// An image that formulas read, by the names of color_names. Its numbers are taken as they are stored, which for
/// colours is as they were painted.
struct Texture {
  std::string name;
  int width = 0;
  int height = 0;
  /// Pixel (x, y), counted from the top left corner, holds its red, green and blue at rgb[3 * (y * width + x)] and the
  /// two places after it; 65535 stands for 1. Copies of a texture share them.
  std::shared_ptr<const std::vector<std::uint16_t>> rgb;
};

/// Red, green and blue, 0..1, linear between the centres of pixels. The image reaches from u = v = 0, its lower left
/// corner, to u = v = 1 and repeats beyond.
std::array<double, 3> color_at(const Texture& texture, double u, double v);

/// The values at the vertices: the mean over the corners that meet there, which at a seam lie in several places of the
/// image. `uv` has two components and sits at vertices or corners; vertices without a
/// triangle get 0, but where there is none at all the colour at their own uv.
VertexAttributes texture_attributes(const Texture& texture, const std::vector<Triangle>& triangles,
                                    std::size_t vertices, const Attribute& uv);

}  // namespace pelage
