#pragma once
// What of a glTF material bears on attributes: its colour, its textures, and where they take their uv.

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "io/gltf_document.h"

namespace pelage {

struct GltfMaterial {
  std::array<double, 4> base_color = {1, 1, 1, 1};  ///< linear, with alpha
  std::string image;                                ///< of the base colour: its file, "" without, "?" inside the glTF
  std::optional<std::size_t> image_number;          ///< of that image in the glTF
  std::size_t uv_set = 0;                           ///< the TEXCOORD of the base colour, or of the first other texture
  /// Columns of the map of its uv (KHR_texture_transform): u * [0] + v * [1] + [2], with v downwards.
  std::array<std::array<double, 2>, 3> uv_map = {{{1, 0}, {0, 1}, {0, 0}}};
  bool other_uv = false;  ///< other textures take theirs from elsewhere
};

GltfMaterial read_material(const GltfDocument& document, std::size_t material);

}  // namespace pelage
