#pragma once
// Numbers in messages and pictures, the same in every locale.

#include <string>

namespace pelage {

/// So many significant digits at most: "0.0312", "1.5e-07".
std::string number(double value, int digits = 6);

/// So many digits behind the point: "0.50".
std::string fixed_number(double value, int decimals);

/// As few digits as make the same number again.
std::string exact_number(double value);

}  // namespace pelage
