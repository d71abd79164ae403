#include "solid/stencil.h"

namespace pelage {

namespace {

constexpr bool is_long(int a, int b) { return a / 2 == b / 2; }

StencilPoint corner(int a) { return {static_cast<std::int8_t>(a), static_cast<std::int8_t>(a)}; }
StencilPoint between(int a, int b) {
  return a < b ? StencilPoint{static_cast<std::int8_t>(a), static_cast<std::int8_t>(b)} : between(b, a);
}

/// In the face of p and q inside and m outside a diagonal cuts p q (qm) (pm) into two: whether it is p (qm). It ends at
/// the cut of the long edge, or at the even corner of a long edge inside: that goes by the face alone, as its other
/// tetrahedron sees it too, and no prism has three diagonals in a ring.
bool begins_at_first(int p, int q, int m, const std::array<bool, 4>& even) {
  return is_long(p, q) ? even[static_cast<std::size_t>(p)] : is_long(q, m);
}

using Triple = std::array<StencilPoint, 3>;

/// A prism between the triangles p and q, where diagonal i runs from p[i] to q[i + 1], or else from p[i + 1] to q[i].
void split_prism(const Triple& p, const Triple& q, const std::array<bool, 3>& diagonal,
                 std::vector<StencilTet>& result) {
  std::size_t i = 0;
  while (!(diagonal[i] && !diagonal[(i + 2) % 3])) ++i;  // two diagonals meet at p[i]
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  result.push_back({p[i], q[0], q[1], q[2]});
  result.push_back({p[i], p[j], p[k], diagonal[j] ? q[k] : q[j]});
  result.push_back({p[i], diagonal[j] ? p[j] : p[k], q[j], q[k]});
}

}  // namespace

void cut_tetrahedron(const std::array<Side, 4>& side, const std::array<bool, 4>& even, bool first_diagonal,
                     std::vector<StencilTet>& result) {
  std::array<int, 4> in{}, on{}, out{};
  std::size_t ins = 0, ons = 0, outs = 0;
  for (int c = 0; c < 4; ++c) {
    const Side s = side[static_cast<std::size_t>(c)];
    if (s == Side::inside) in[ins++] = c;
    if (s == Side::on) on[ons++] = c;
    if (s == Side::outside) out[outs++] = c;
  }
  if (ins == 0) return;
  const auto [a, b, c, d] = in;
  if (outs == 0) {
    result.push_back({corner(0), corner(1), corner(2), corner(3)});
  } else if (ins == 1) {
    StencilTet t{corner(a)};
    for (std::size_t k = 0; k < ons; ++k) t[1 + k] = corner(on[k]);
    for (std::size_t k = 0; k < outs; ++k) t[1 + ons + k] = between(a, out[k]);
    result.push_back(t);
  } else if (ins == 2 && ons == 1) {
    const int m = out[0];
    const bool first = begins_at_first(a, b, m, even);
    result.push_back({corner(on[0]), corner(a), corner(b), first ? between(b, m) : between(a, m)});
    result.push_back({corner(on[0]), first ? corner(a) : corner(b), between(b, m), between(a, m)});
  } else if (ins == 2) {
    const int m = out[0], n = out[1];
    const bool middle = is_long(a, b) ? first_diagonal : is_long(a, m);
    split_prism({corner(a), between(a, m), between(a, n)}, {corner(b), between(b, m), between(b, n)},
                {begins_at_first(a, b, m, even), middle, !begins_at_first(a, b, n, even)}, result);
  } else {
    const int m = out[0];
    split_prism({corner(a), corner(b), corner(c)}, {between(a, m), between(b, m), between(c, m)},
                {begins_at_first(a, b, m, even), begins_at_first(b, c, m, even), begins_at_first(c, a, m, even)},
                result);
  }
}

}  // namespace pelage
