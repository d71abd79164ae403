#include "io/vertex_colors.h"

#include <algorithm>
#include <utility>

#include "base/srgb.h"

namespace pelage {

namespace {

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

}  // namespace

Attribute linear_color(std::vector<double> values, int components) {
  const bool bytes = std::any_of(values.begin(), values.end(), [](double x) { return x > 1; });
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double encoded = bytes ? values[i] / 255 : values[i];
    values[i] = i % components == 3 ? encoded : linear_from_srgb(encoded);
  }
  Attribute color{"color", components, Domain::vertex, std::move(values)};
  drop_opaque_alpha(color);
  return color;
}

}  // namespace pelage
