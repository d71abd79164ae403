#pragma once
// Numbers that become indices: what lies outside of the integers' range is undefined to the language.

#include <concepts>
#include <limits>
#include <string>
#include <utility>

#include "pelage/error.h"

namespace pelage {

/// The number cut off towards zero, or the nearest end of the range of integers; 0 for what is not a number.
template <std::integral Integer>
constexpr Integer saturated(double x) {
  using Limits = std::numeric_limits<Integer>;
  constexpr auto low = static_cast<double>(Limits::min());
  constexpr double high = 2.0 * static_cast<double>(Limits::max() / 2 + 1);  // one more than the largest, exactly
  if (x != x) return 0;
  if (x <= low) return Limits::min();
  return x < high ? static_cast<Integer>(x) : Limits::max();
}

/// A count in another type; Error(Fault::input) "too many WHAT" where it has no room.
template <std::integral Integer, std::integral Count>
Integer checked_count(Count count, const std::string& what) {
  if (std::in_range<Integer>(count)) return static_cast<Integer>(count);
  throw Error(Fault::input, "too many " + what + ": " + std::to_string(count) + ", at most " +
                                std::to_string(std::numeric_limits<Integer>::max()) +
                                " can be used; take a smaller mesh");
}

}  // namespace pelage
