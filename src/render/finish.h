#pragma once
// What a surface is like at one place, beside its colour: the channels of a mesh (pelage/channel.h).

#include "pelage/channel.h"

namespace pelage {

struct Finish {
  static constexpr float usual(Channel channel) { return static_cast<float>(kind_of(channel).usual); }

  float roughness = usual(Channel::roughness), metalness = usual(Channel::metalness), opacity = usual(Channel::opacity),
        emission = usual(Channel::emission), transmission = usual(Channel::transmission),
        thickness = usual(Channel::thickness);  ///< in units of the object's size

  void add(float weight, const Finish& other) {
    roughness += weight * other.roughness;
    metalness += weight * other.metalness;
    opacity += weight * other.opacity;
    emission += weight * other.emission;
    transmission += weight * other.transmission;
    thickness += weight * other.thickness;
  }

  /// How far it is glass.
  float glass() const { return transmission * (1 - metalness); }
  /// How far it is a surface that light does not pass.
  float opaque() const { return opacity * (1 - glass()); }
  /// The share of light that does not go straight on: glass bends some of it away.
  float shading() const { return opacity * (1 - 0.8F * glass()); }
};

}  // namespace pelage
