#pragma once
// Reactions given sample by sample, for systems without a model.

#include <algorithm>
#include <functional>

#include "time/system.h"

namespace pelage {

/// R = c2 u + c3 of all species at one sample, from their values there and the time; c2 and c3 come as zeros.
using SplitAtSample =
    std::function<void(const std::vector<double>& u, double t, std::vector<double>& c2, std::vector<double>& c3)>;

inline void set_reaction(System& system, const SplitAtSample& split) {
  const auto at_samples = [split](const FieldPointers& u, double t, std::size_t begin, std::size_t end, auto&& take) {
    std::vector<double> value(u.size()), c2(u.size()), c3(u.size());
    for (std::size_t n = begin; n < end; ++n) {
      for (std::size_t i = 0; i < u.size(); ++i) value[i] = u[i][n];
      std::ranges::fill(c2, 0);
      std::ranges::fill(c3, 0);
      split(value, t, c2, c3);
      for (std::size_t i = 0; i < u.size(); ++i) take(i, n, value[i], c2[i], c3[i]);
    }
  };
  system.reaction.split = [at_samples](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                       const MutableFieldPointers& c2, const MutableFieldPointers& c3) {
    at_samples(u, t, begin, end, [&](std::size_t i, std::size_t n, double, double a, double b) {
      c2[i][n] = a;
      c3[i][n] = b;
    });
  };
  system.reaction.rates = [at_samples](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                       const MutableFieldPointers& rate) {
    at_samples(u, t, begin, end,
               [&](std::size_t i, std::size_t n, double value, double a, double b) { rate[i][n] = a * value + b; });
  };
}

}  // namespace pelage
