#include "react/tape_kernels.h"

#include <array>
#include <utility>

namespace pelage {

namespace {

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
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], 0, 0);
  } else if constexpr (arity(op) == 2) {
    const Operand<(mask & 2u) != 0> y(b);
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], y[i], 0);
  } else if constexpr (arity(op) == 3) {
    const Operand<(mask & 2u) != 0> y(b);
    const Operand<(mask & 4u) != 0> z(c);
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], y[i], z[i]);
  }
}

template <bool from_scalar>
void copy(const double* a, const double*, const double*, double* __restrict out, std::size_t count) {
  const Operand<from_scalar> x(a);
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

}  // namespace

TapeKernel tape_kernel(Op op, unsigned scalar_mask) { return table[static_cast<std::size_t>(op)][scalar_mask]; }

TapeKernel copy_kernel(bool from_scalar) { return from_scalar ? &copy<true> : &copy<false>; }

}  // namespace pelage
