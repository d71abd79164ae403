#pragma once
// What a coat reflects as a mirror would, beside its colour: the highlight of the lamp and the sheen of the room.

#include <Eigen/Core>

namespace pelage {

/// The highlight of light that comes from `light` with unit irradiance over pi, times the cosine at the surface
/// (GGX; Walter et al. 2007, with the visibility term of Karis 2013). All directions are unit vectors that point away
/// from the surface.
float highlight(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, const Eigen::Vector3f& light);

/// The share of the room's light that the coat reflects without colouring it, for the cosine of view and normal.
float sheen(float cosine);

}  // namespace pelage
