#pragma once
// Smooth values on a triangle from values and first derivatives at its corners.

#include <array>
#include <cstddef>

namespace pelage {

/// A number or vector at (1-v-w) a + v b + w c: the cubic Bezier triangle whose edges are the Hermite curves of
/// `corner` and `toward`, with the inner control point that reproduces quadratics (Vlachos, Peters, Boyd, Mitchell
/// 2001, "Curved PN triangles", eq. (1) and section 3.1). toward[k][0] and [k][1]: derivatives at corner k along the
/// edges to the next corner and to the one after.
template <class Value>
Value cubic_triangle(const std::array<Value, 3>& corner, const std::array<std::array<Value, 2>, 3>& toward, double v,
                     double w) {
  const std::array<double, 3> x = {1 - v - w, v, w};
  Value sum = 0 * corner[0], edges = sum, corners = sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, after = (k + 2) % 3;
    const Value one = corner[k] + toward[k][0] / 3, other = corner[k] + toward[k][1] / 3;
    edges += one + other;
    corners += corner[k];
    sum += x[k] * x[k] * (x[k] * corner[k] + 3 * x[next] * one + 3 * x[after] * other);
  }
  return sum + 6 * x[0] * x[1] * x[2] * (edges / 4 - corners / 6);
}

}  // namespace pelage
