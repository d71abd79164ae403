#include "io/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number.h"
#include "base/srgb.h"

namespace pelage {

namespace {

double white_of(const std::vector<double>& values, NumberType type, std::vector<Finding>& findings) {
  if (const double full = full_scale(type); full > 1) return full;
  const auto brightest = std::ranges::max_element(values);
  if (brightest == values.end() || !(*brightest > 1)) return 1;
  if (!std::ranges::all_of(values, [](double x) { return x == std::floor(x); }))
    findings.push_back({"colours-above-1", "colours of up to " + number(*brightest) + "; taken to count from 0 to 255",
                        1, static_cast<std::size_t>(brightest - values.begin()), false});
  return 255;
}

}  // namespace

double full_scale(NumberType type) {
  if (type == NumberType::uint8 || type == NumberType::int8) return 255;
  if (type == NumberType::uint16 || type == NumberType::int16) return 65535;
  return 1;
}

Attribute linear_color(std::vector<double> values, int components, std::vector<Finding>& findings, NumberType type,
                       Domain domain) {
  const double white = white_of(values, type, findings);
  const auto n = static_cast<std::size_t>(components);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double painted = values[i] / white;
    values[i] = i % n == 3 ? painted : linear_from_srgb(painted);
  }
  return {"color", components, domain, std::move(values), white == 255 ? NumberType::uint8 : type};
}

void drop_opaque_alpha(Attribute& color) {
  if (color.components != 4) return;
  const std::size_t n = color.values.size() / 4;
  for (std::size_t i = 0; i < n; ++i)
    if (color.values[4 * i + 3] != 1) return;
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(color.values.begin() + static_cast<std::ptrdiff_t>(4 * i), 3,
                color.values.begin() + static_cast<std::ptrdiff_t>(3 * i));
  color.values.resize(3 * n);
  color.components = 3;
}

}  // namespace pelage
