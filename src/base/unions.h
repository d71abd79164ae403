#pragma once
// Sets that are joined.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pelage {

/// Numbers that stand for themselves or for the smallest one that they are united with.
class Unions {
 public:
  using Number = std::int32_t;
  explicit Unions(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Number{0}); }
  Number root(Number a) {
    while (parent(a) != a) a = parent(a) = parent(parent(a));
    return a;
  }
  void unite(Number a, Number b) {
    a = root(a);
    b = root(b);
    parent(std::max(a, b)) = std::min(a, b);
  }

 private:
  Number& parent(Number a) { return parent_[static_cast<std::size_t>(a)]; }
  std::vector<Number> parent_;
};

}  // namespace pelage
