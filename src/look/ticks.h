#pragma once
// Round numbers along an axis.

#include <string>
#include <vector>

namespace pelage {

struct Tick {
  double value = 0;
  std::string label;
};

/// Multiples of 1, 2 or 5 times a power of ten within [low, high], as many as possible but at most `most` (>= 2).
/// All labels have the same number of decimals; very large and small values are written as multiples of a power.
std::vector<Tick> round_ticks(double low, double high, int most);

/// A number for a label: at most `digits` significant ones, with a true minus sign.
std::string label_of(double value, int digits = 4);

}  // namespace pelage
