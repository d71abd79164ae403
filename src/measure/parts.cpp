#include "measure/parts.h"

#include "base/unions.h"

namespace pelage {

PartNumbers connected_parts(const std::vector<Triangle>& triangles, const std::vector<double>& values, double level,
                            bool above) {
  const auto inside = [&](std::int32_t v) { return (values[static_cast<std::size_t>(v)] > level) == above; };
  Unions parts(values.size());
  PartNumbers numbers{0, std::vector<std::int32_t>(values.size(), -1)};
  std::vector<char> used(values.size(), 0);
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!inside(t[k])) continue;
      used[static_cast<std::size_t>(t[k])] = 1;
      if (const std::int32_t next = t[(k + 1) % 3]; inside(next)) parts.unite(t[k], next);
    }
  for (std::size_t v = 0; v < used.size(); ++v) {  // a root is the smallest number of its part
    if (!used[v]) continue;
    const std::int32_t root = parts.root(static_cast<std::int32_t>(v));
    numbers.of[v] = root == static_cast<std::int32_t>(v) ? static_cast<std::int32_t>(numbers.count++)
                                                         : numbers.of[static_cast<std::size_t>(root)];
  }
  return numbers;
}

}  // namespace pelage
