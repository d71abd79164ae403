#pragma once
// Linear combinations of control values: the form in which subdivision and limit evaluation are kept, so that
// positions, concentrations and uv go through the same weights.

#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "shape/topology.h"

namespace pelage {

/// Row r is the sum of weight[k] * value[index[k]] over k in [start[r], start[r+1]).
struct Stencils {
  Index columns = 0;
  std::vector<std::int64_t> start{0};
  std::vector<Index> index;
  std::vector<double> weight;

  std::size_t rows() const { return start.size() - 1; }
  void add(Index i, double w) {
    index.push_back(i);
    weight.push_back(w);
  }
  void end_row() { start.push_back(static_cast<std::int64_t>(index.size())); }
};

/// values: columns x components, tuple after tuple; result: rows x components.
template <class Value>
std::vector<Value> combine(const Stencils& stencils, const std::vector<Value>& values, std::size_t components = 1) {
  std::vector<Value> result(stencils.rows() * components);
  parallel_for(stencils.rows(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      for (std::size_t c = 0; c < components; ++c) {
        Value sum{};
        for (auto k = static_cast<std::size_t>(stencils.start[r]); k < static_cast<std::size_t>(stencils.start[r + 1]);
             ++k)
          sum += stencils.weight[k] * values[static_cast<std::size_t>(stencils.index[k]) * components + c];
        result[r * components + c] = sum;
      }
  });
  return result;
}

std::vector<Point> combine(const Stencils& stencils, const std::vector<Point>& points);

}  // namespace pelage
