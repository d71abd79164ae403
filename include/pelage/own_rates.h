#pragma once
// Reactions computed by a program of your own instead of the formulas of a model. Diffusion, time and all else stay
// with the library.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace pelage {

/// Rates of all species of a stage at its samples [begin, end) at model time t, in model units: u[i][s] is the
/// concentration of species i at sample s and rate[i][s] takes R_i there, for s from 0 to end - begin - 1. `u` comes in
/// the order of the model and ends, where its rates read products of gradients, with these. Called from several threads
/// for disjoint ranges; must give the same for the same values. What it throws ends the step and is thrown on. Unless
/// a recipe says otherwise, its steps are those of "sbdf2", which asks for many samples at a time.
struct OwnRates {
  std::string stage = {};  ///< of the recipe; empty: the last
  std::function<void(const std::vector<const double*>& u, double t, std::size_t begin, std::size_t end,
                     const std::vector<double*>& rate)>
      rates = {};
};

}  // namespace pelage
