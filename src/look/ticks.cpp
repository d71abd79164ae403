#include "look/ticks.h"

#include <algorithm>
#include <cmath>

#include "base/checked.h"
#include "base/number.h"

namespace pelage {

namespace {

const std::string minus = "\u2212";

std::string with_true_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, minus);
  return text;
}

std::string superscript(int exponent) {
  const char* digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                          "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "\u207b" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

/// The smallest of 1, 2, 5, 10, ... times a power of ten that is at least x.
double round_step(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= x * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

int exponent_of(double x) { return saturated<int>(std::floor(std::log10(x) + 1e-9)); }

std::string tick_label(double value, double step, double largest) {
  const int exponent = exponent_of(largest), last = exponent_of(step);
  if (exponent >= -4 && exponent < 6) return with_true_minus(fixed_number(value, -last));
  if (value == 0) return "0";
  return with_true_minus(fixed_number(value / std::pow(10.0, exponent), exponent - last)) + "\u00b710" +
         superscript(exponent);
}

}  // namespace

std::vector<Tick> round_ticks(double low, double high, int most) {
  if (!(high > low)) return {};
  double step = round_step((high - low) / most);
  const auto first = [&] { return std::ceil(low / step - 1e-9); };
  const auto last = [&] { return std::floor(high / step + 1e-9); };
  while (last() - first() + 1 > most) step = round_step(step * 1.01);
  std::vector<Tick> ticks;
  for (double i = first(); i <= last(); ++i) {
    const double value = i == 0 ? 0 : i * step;  // no negative zero
    ticks.push_back({value, tick_label(value, step, std::max(std::abs(low), std::abs(high)))});
  }
  return ticks;
}

std::string label_of(double value, int digits) { return with_true_minus(number(value, digits)); }

}  // namespace pelage
