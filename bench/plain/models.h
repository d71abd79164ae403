#pragma once
// Three of Pelage's models written by hand (models/*.toml), both species of a place at once.

#include <Eigen/Core>

namespace plain {

template <class R>
using Pair = Eigen::Array<R, 2, 1>;

/// What all of them say: the diffusions [model length^2 / model time], the largest |dR/du| that occurs, which makes the
/// reaction's share of the spectral radius, and the rates. `place` is a number that differs from vertex to vertex.
struct Schnakenberg {  // v, u
  static constexpr double diffusion[] = {40, 1}, stiff = 20;
  template <class R>
  static Pair<R> rates(const Pair<R>& c, R /*place*/) {
    const R reaction = c[1] * c[1] * c[0];
    return {R(0.9) - reaction, R(0.1) - c[1] + reaction};
  }
};

struct Turing {  // a, b of turing:production; the place is the uneven substrate beta
  static constexpr double diffusion[] = {0.140625, 0.03125}, stiff = 0.5;
  template <class R>
  static Pair<R> rates(const Pair<R>& c, R beta) {
    const R product = c[0] * c[1];
    return R(0.05) * Pair<R>(R(16) - product, product - c[1] - beta);
  }
};

struct GrayScott {  // u, v of gray-scott:spots
  static constexpr double diffusion[] = {0.2097, 0.1049}, stiff = 1;
  template <class R>
  static Pair<R> rates(const Pair<R>& c, R /*place*/) {
    constexpr R feed = R(0.0367), kill = R(0.0649);
    const R reaction = c[0] * c[1] * c[1];
    return {feed * (1 - c[0]) - reaction, reaction - (feed + kill) * c[1]};
  }
};

}  // namespace plain
