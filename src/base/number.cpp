#include "base/number.h"

#include <algorithm>
#include <charconv>

namespace pelage {

std::string number(double value, int digits) {
  char buffer[64];
  return {
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, std::clamp(digits, 1, 17)).ptr};
}

std::string fixed_number(double value, int decimals) {
  char buffer[400];  // the largest numbers have 309 digits before the point
  return {
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, std::clamp(decimals, 0, 40)).ptr};
}

std::string exact_number(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

}  // namespace pelage
