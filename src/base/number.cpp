#include "base/number.h"

#include <cstdio>

namespace pelage {

std::string number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

}  // namespace pelage
