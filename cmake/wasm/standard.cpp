// See standard.h.

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

namespace std {

namespace {

template <class Real>
from_chars_result parsed(const char* first, const char* last, Real& value) {
  Real found = 0;
  const fast_float::from_chars_result result = fast_float::from_chars(first, last, found);
  if (result.ec != errc()) return {result.ptr, result.ec};
  // What is too large or too small for the type, for which this version of fast_float gives infinity and zero.
  const char* digits = first + (*first == '-');
  const bool written_infinite = *digits == 'i' || *digits == 'I';
  const bool written_zero = none_of(digits, find_if(digits, result.ptr, [](char c) { return c == 'e' || c == 'E'; }),
                                    [](char c) { return c >= '1' && c <= '9'; });
  if ((isinf(found) && !written_infinite) || (found == 0 && !written_zero))
    return {result.ptr, errc::result_out_of_range};
  value = found;
  return {result.ptr, errc()};
}

to_chars_result copied(const string& text, char* first, char* last) {
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  return {copy(text.begin(), text.end(), first), errc()};
}

string printed(const char* format, int precision, double value) {
  char buffer[512];
  return {buffer, static_cast<size_t>(snprintf(buffer, sizeof buffer, format, precision, value))};
}

float reread(const string& text, float) { return strtof(text.c_str(), nullptr); }
double reread(const string& text, double) { return strtod(text.c_str(), nullptr); }

/// The next number, away from zero, in scientific notation with as many digits; not where all are nines.
string next_number(string text) {
  for (size_t i = text.find('e'); i-- > 0;) {
    if (text[i] < '0' || text[i] > '9') continue;
    if (text[i] != '9') {
      ++text[i];
      break;
    }
    text[i] = '0';
  }
  return text;
}

/// In scientific notation with the fewest digits that make the same number again, of these the nearest. That may be the
/// second nearest of all numbers with so many digits: below a power of two the next number is half as far as above.
template <class Real>
string shortest_scientific(Real value) {
  for (int digits = 0; digits + 1 < numeric_limits<Real>::max_digits10; ++digits) {
    const string nearest = printed("%.*e", digits, value), next = next_number(nearest);
    if (reread(nearest, value) == value) return nearest;
    if (reread(next, value) == value) return next;
  }
  return printed("%.*e", numeric_limits<Real>::max_digits10 - 1, value);
}

/// The shorter of scientific and plain notation, plain where both are equally long.
template <class Real>
to_chars_result shortest(char* first, char* last, Real value) {
  if (!isfinite(value)) return copied(printed("%.*f", 0, value), first, last);
  const string scientific = shortest_scientific(value);
  const int digits = static_cast<int>(count_if(scientific.begin(), scientific.begin() + scientific.find('e'),
                                               [](char c) { return c >= '0' && c <= '9'; }));
  const int exponent = atoi(scientific.c_str() + scientific.find('e') + 1);
  const string plain = printed("%.*f", max(0, digits - 1 - exponent), value);
  return copied(plain.size() <= scientific.size() ? plain : scientific, first, last);
}

}  // namespace

from_chars_result from_chars(const char* first, const char* last, float& value) { return parsed(first, last, value); }
from_chars_result from_chars(const char* first, const char* last, double& value) { return parsed(first, last, value); }

to_chars_result to_chars(char* first, char* last, float value) { return shortest(first, last, value); }
to_chars_result to_chars(char* first, char* last, double value) { return shortest(first, last, value); }
to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
  return copied(printed(format == chars_format::fixed ? "%.*f" : "%.*g", precision, value), first, last);
}

}  // namespace std
