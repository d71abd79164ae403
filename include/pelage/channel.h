#pragma once
// What a coat is like beside its colour: one number at each place, as glTF 2.0 means it. Meshes hold it as vertex
// attributes of the names below.

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

namespace pelage {

enum class Channel : std::size_t { height, roughness, metalness, opacity, emission, transmission, thickness };

struct ChannelKind {
  Channel channel;
  std::string_view name;
  std::string_view attribute;  ///< of meshes
  double usual;                ///< where nothing else is said
  double low, high;            ///< beyond which it means nothing
  bool length;                 ///< looks give it in sizes of the pattern, meshes hold it in their units
  std::string_view meaning;
};

constexpr double no_bound = std::numeric_limits<double>::infinity();

// clang-format off
inline constexpr std::array<ChannelKind, 7> channel_kinds = {{
    {Channel::height,       "height",       "material_height",       0,   -no_bound, no_bound, true,  "above the surface"},
    {Channel::roughness,    "roughness",    "material_roughness",    0.8, 0,         1,        false, "0: a mirror, 1: matt"},
    {Channel::metalness,    "metalness",    "material_metalness",    0,   0,         1,        false, "1: metal in the coat's colour"},
    {Channel::opacity,      "opacity",      "material_opacity",      1,   0,         1,        false, "0: nothing is there"},
    {Channel::emission,     "emission",     "material_emission",     0,   0,         no_bound, false, "light of its own, times the colour"},
    {Channel::transmission, "transmission", "material_transmission", 0,   0,         1,        false, "1: glass in the coat's colour"},
    {Channel::thickness,    "thickness",    "material_thickness",    0,   0,         no_bound, true,  "of the glass; 0: a thin wall"},
}};
// clang-format on

constexpr const ChannelKind& kind_of(Channel channel) { return channel_kinds[static_cast<std::size_t>(channel)]; }

}  // namespace pelage
