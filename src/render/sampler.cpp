#include "render/sampler.h"

namespace pelage {

namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x >> 4) & 0x0f0f0f0f) | ((x & 0x0f0f0f0f) << 4);
  x = ((x >> 2) & 0x33333333) | ((x & 0x33333333) << 2);
  return ((x >> 1) & 0x55555555) | ((x & 0x55555555) << 1);
}

/// Flips each bit depending on the bits above it: a random permutation of the binary tree over [0, 2^32).
std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse_bits(x);
  // The Laine-Karras permutation with the constants of Burley 2020, section 4.
  x += seed;
  x ^= x * 0x6c50b47c;
  x ^= x * 0xb82f1e52;
  x ^= x * 0xc7afe638;
  x ^= x * 0x8d22f6e6;
  return reverse_bits(x);
}

std::uint32_t mix(std::uint32_t seed, std::uint32_t salt) {
  std::uint32_t x = seed ^ (salt * 0x9e3779b9);
  x = (x ^ (x >> 16)) * 0x7feb352d;
  x = (x ^ (x >> 15)) * 0x846ca68b;
  return x ^ (x >> 16);
}

/// Second dimension before the reversal of bits: bit j is the parity of the index bits k with C(k, j) odd, which by
/// Lucas' theorem are those whose number k contains all ones of j. Five butterflies sum over these.
std::uint32_t pascal_transform(std::uint32_t x) {
  x ^= x >> 16;
  x ^= (x >> 8) & 0x00ff00ff;
  x ^= (x >> 4) & 0x0f0f0f0f;
  x ^= (x >> 2) & 0x33333333;
  return x ^ ((x >> 1) & 0x55555555);
}

/// 24 bits: exact as a float and below 1.
float to_unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24F; }

}  // namespace

std::array<float, 2> scrambled_sobol(std::uint32_t index, std::uint32_t seed) {
  const std::uint32_t shuffled = owen_scramble(index, mix(seed, 0));
  const std::uint32_t x = reverse_bits(shuffled), y = reverse_bits(pascal_transform(shuffled));
  return {to_unit(owen_scramble(x, mix(seed, 1))), to_unit(owen_scramble(y, mix(seed, 2)))};
}

std::uint32_t z_order(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint32_t v) {
    v = (v | (v << 8)) & 0x00ff00ff;
    v = (v | (v << 4)) & 0x0f0f0f0f;
    v = (v | (v << 2)) & 0x33333333;
    return (v | (v << 1)) & 0x55555555;
  };
  return spread(x & 0xffff) | (spread(y & 0xffff) << 1);
}

}  // namespace pelage
