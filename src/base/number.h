#pragma once
// Numbers in messages.

#include <string>

namespace pelage {

/// Six significant digits at most: "0.0312", "1.5e-07".
std::string number(double value);

/// As few digits as make the same number again.
std::string exact_number(double value);

}  // namespace pelage
