#include "measure/parts.h"

#include "base/unions.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// In the order of their first members; -1 for those that are not used.
PartNumbers numbers_of(Unions& parts, const std::vector<char>& used) {
  PartNumbers numbers{0, std::vector<std::int32_t>(used.size(), -1)};
  for (std::size_t v = 0; v < used.size(); ++v) {  // a root is the smallest number of its part
    if (!used[v]) continue;
    const std::int32_t root = parts.root(static_cast<std::int32_t>(v));
    numbers.of[v] = at(root) == v ? static_cast<std::int32_t>(numbers.count++) : numbers.of[at(root)];
  }
  return numbers;
}

}  // namespace

PartNumbers connected_parts(const std::vector<Triangle>& triangles, const std::vector<double>& values, double level,
                            bool above) {
  const auto inside = [&](std::int32_t v) { return (values[at(v)] > level) == above; };
  Unions parts(values.size());
  std::vector<char> used(values.size(), 0);
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!inside(t[k])) continue;
      used[at(t[k])] = 1;
      if (const std::int32_t next = t[(k + 1) % 3]; inside(next)) parts.unite(t[k], next);
    }
  return numbers_of(parts, used);
}

PartNumbers connected_nodes(const SparsePattern& joined, const std::vector<double>& values, double level, bool above) {
  std::vector<char> used(values.size());
  for (std::size_t v = 0; v < used.size(); ++v) used[v] = (values[v] > level) == above;
  Unions parts(values.size());
  for (std::size_t v = 0; v < used.size(); ++v)
    for (auto k = joined.start[v]; k < joined.start[v + 1]; ++k)
      if (const std::int32_t w = joined.column[at(k)]; used[v] && used[at(w)])
        parts.unite(static_cast<std::int32_t>(v), w);
  return numbers_of(parts, used);
}

}  // namespace pelage
