#pragma once
// Minima of smooth functions of many variables that are infinite where they may not go: limited-memory BFGS (Nocedal,
// "Updating quasi-Newton matrices with limited storage", 1980) with steps that are shortened until the value is finite
// and falls.

#include <functional>
#include <vector>

namespace pelage {

struct MinimiseOptions {
  int most_iterations = 2000;
  double tolerance = 1e-6;  ///< stops where `window` iterations take away less than this share of the value
  int window = 20;
};

struct Minimum {
  double value = 0;
  int iterations = 0;
  bool converged = false;
};

/// The function's value; fills the gradient, which has the size of its argument, where the value is finite.
using Objective = std::function<double(const std::vector<double>& x, std::vector<double>& gradient)>;

/// Starts at x, where the value must be finite, and leaves the lowest place there. The same bits for any number of
/// threads.
Minimum minimise(const Objective& objective, std::vector<double>& x, const MinimiseOptions& options = {});

}  // namespace pelage
