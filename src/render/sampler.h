#pragma once
// Well-spread random points for pictures, each a function of pixel, sample and purpose alone.

#include <array>
#include <cstdint>

namespace pelage {

/// Point `index` of the first two dimensions of Sobol's sequence, shuffled and Owen-scrambled by hashing
/// (Burley, "Practical Hash-based Owen Scrambling", JCGT 2020). Every aligned block of 2^m indices has one point
/// in each of the 2^m boxes of any elementary shape. Coordinates in [0, 1).
std::array<float, 2> scrambled_sobol(std::uint32_t index, std::uint32_t seed);

/// Number of a pixel along the Z curve: neighbours in the picture are neighbours in the sequence, so that their
/// errors cancel for the eye (Ahmed and Wonka, "Screen-Space Blue-Noise Diffusion", 2020). 16 bits each.
std::uint32_t z_order(std::uint32_t x, std::uint32_t y);

}  // namespace pelage
