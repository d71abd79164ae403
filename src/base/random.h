#pragma once
// Counter-based random numbers: a value depends only on its key, never on the order of the calls.

#include <array>
#include <cstdint>

namespace pelage {

/// A well-mixed 64-bit value for (seed, counter): two rounds of the finaliser of SplitMix64
/// (Steele, Lea, Flood 2014).
constexpr std::uint64_t hash(std::uint64_t seed, std::uint64_t counter) {
  auto mix = [](std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  };
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;  // 2^64 / golden ratio: spreads small counters
  return mix(mix(seed + golden) ^ (counter * golden + 1));
}

/// Uniform in [0, 1), 53 bits.
constexpr double uniform(std::uint64_t seed, std::uint64_t counter) {
  return static_cast<double>(hash(seed, counter) >> 11) * 0x1.0p-53;
}

/// A seed of its own for every place: places less than about a thousandth of `length` apart share one, so that the
/// rounding of coordinates decides nothing.
std::uint64_t place_seed(const std::array<double, 3>& place, double length, std::uint64_t seed);

/// Band-limited noise at a place in space: independent lattice values of spacing `length`, smoothed by the
/// tensor product of cubic B-splines. Mean 0, variance 1 (averaged over space), twice continuously
/// differentiable; features much smaller than `length` are absent. Depends on the place, not on any mesh. Beyond 2^62
/// lengths from the origin, where places are further apart than features, it is constant. `period`: 0, or after which
/// it repeats along an axis, for which `length` there becomes the nearest that divides it.
double smooth_noise(const std::array<double, 3>& place, double length, std::uint64_t seed,
                    const std::array<double, 3>& period = {});

}  // namespace pelage
