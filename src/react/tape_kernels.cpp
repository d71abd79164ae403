#include "react/tape_kernels.h"

#include <array>
#include <utility>

namespace pelage {

namespace {

// The loops are unrolled because counting costs as much as the arithmetic in loops this small.
//
// An operand is read by value(i); a scalar is loaded once, outside of the loop. The tape never lets a result
// share memory with an operand, which is what __restrict promises to the vectoriser.
template <bool is_scalar>
struct Operand {
  explicit Operand(const double* data) : values(data) {}
  double operator[](std::size_t i) const { return values[i]; }
  const double* __restrict values;
};
template <>
struct Operand<true> {
  explicit Operand(const double* data) : value(*data) {}
  double operator[](std::size_t) const { return value; }
  double value;
};

template <Op op, unsigned mask>
void loop(const double* a, const double* b, const double* c, double* __restrict out, std::size_t count) {
  const Operand<(mask & 1u) != 0> x(a);
  if constexpr (arity(op) == 1) {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], 0, 0);
  } else if constexpr (arity(op) == 2) {
    const Operand<(mask & 2u) != 0> y(b);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], y[i], 0);
  } else if constexpr (arity(op) == 3) {
    const Operand<(mask & 2u) != 0> y(b);
    const Operand<(mask & 4u) != 0> z(c);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], y[i], z[i]);
  }
}

template <Op inner, Op op, bool inner_last, unsigned mask>
void fused_loop(const double* a, const double* b, const double* c, double* __restrict out, std::size_t count) {
  const Operand<(mask & 1u) != 0> x(a);
  const Operand<(mask & 2u) != 0> y(b);
  const Operand<(mask & 4u) != 0> z(c);
  const auto value = [](double p, double q, double r) {
    const double first = apply<inner>(p, q, 0);
    return inner_last ? apply<op>(r, first, 0) : apply<op>(first, r, 0);
  };
#pragma GCC unroll 8
  for (std::size_t i = 0; i < count; ++i) out[i] = value(x[i], y[i], z[i]);
}

template <bool from_scalar>
void copy(const double* a, const double*, const double*, double* __restrict out, std::size_t count) {
  const Operand<from_scalar> x(a);
#pragma GCC unroll 8
  for (std::size_t i = 0; i < count; ++i) out[i] = x[i];
}

template <Op op>
constexpr std::array<TapeKernel, 8> variants() {
  if constexpr (arity(op) == 0) return {};
  if constexpr (arity(op) == 1) return {&loop<op, 0>, &loop<op, 1>};
  if constexpr (arity(op) == 2) return {&loop<op, 0>, &loop<op, 1>, &loop<op, 2>, &loop<op, 3>};
  if constexpr (arity(op) == 3)
    return {&loop<op, 0>, &loop<op, 1>, &loop<op, 2>, &loop<op, 3>,
            &loop<op, 4>, &loop<op, 5>, &loop<op, 6>, &loop<op, 7>};
}

template <std::size_t... I>
constexpr auto make_table(std::index_sequence<I...>) {
  return std::array{variants<static_cast<Op>(I)>()...};
}

constexpr auto table = make_table(std::make_index_sequence<static_cast<std::size_t>(Op::count)>{});

constexpr std::array<Op, 3> fusible = {Op::add, Op::subtract, Op::multiply};

std::size_t fusible_number(Op op) { return op == Op::add ? 0 : op == Op::subtract ? 1 : 2; }

/// All fused loops, in the order [inner][op][inner_last][mask].
template <std::size_t... I>
constexpr auto make_fused_table(std::index_sequence<I...>) {
  return std::array<TapeKernel, sizeof...(I)>{
      &fused_loop<fusible[I / 48], fusible[I / 16 % 3], (I / 8 % 2) != 0, static_cast<unsigned>(I % 8)>...};
}

constexpr auto fused_table = make_fused_table(std::make_index_sequence<3 * 3 * 2 * 8>{});

}  // namespace

TapeKernel fused_kernel(Op inner, Op op, bool inner_last, unsigned scalar_mask) {
  return fused_table[((fusible_number(inner) * 3 + fusible_number(op)) * 2 + (inner_last ? 1 : 0)) * 8 + scalar_mask];
}

TapeKernel tape_kernel(Op op, unsigned scalar_mask) { return table[static_cast<std::size_t>(op)][scalar_mask]; }

TapeKernel copy_kernel(bool from_scalar) { return from_scalar ? &copy<true> : &copy<false>; }

}  // namespace pelage
