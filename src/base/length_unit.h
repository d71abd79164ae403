#pragma once
// Units of length by their names.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// Of "mm", "cm", "m", "in", "ft" and others; nothing for names that are none.
std::optional<double> metres_in(std::string_view unit);

/// The names, small ones first.
std::vector<std::string> length_unit_names();

/// The name of the unit that has so many metres; "units of 0.3 m" where it has none.
std::string unit_name(double metres);

/// "4 mm", "1.5 m": millimetres below a metre.
std::string length_in_words(double metres);

}  // namespace pelage
