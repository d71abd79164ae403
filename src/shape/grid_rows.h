#pragma once
// Sheets and lines in the order of pictures.

#include <cassert>
#include <cstddef>
#include <vector>

#include "pelage/grid.h"

namespace pelage {

/// The numbers of a sheet's nodes, or of a line's, row by row from the highest y down: pixel (x, y), counted from the
/// top left corner, is the node (x, count[1] - 1 - y). Of the `components` numbers per node those from `first` on,
/// `taken` of them.
template <class Number = float>
std::vector<Number> in_rows(const Grid& grid, const std::vector<double>& values, std::size_t components = 1,
                            std::size_t first = 0, std::size_t taken = 1) {
  assert(grid.count[2] == 1 && values.size() == components * grid.nodes() && first + taken <= components);
  std::vector<Number> rows;
  rows.reserve(taken * grid.nodes());
  const auto width = static_cast<std::size_t>(grid.count[0]);
  for (auto j = static_cast<std::size_t>(grid.count[1]); j-- > 0;)
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t k = first; k < first + taken; ++k)
        rows.push_back(static_cast<Number>(values[components * (width * j + i) + k]));
  return rows;
}

}  // namespace pelage
