// The inner loops of Tape for one instruction set (base/each_instruction_set.h), and the table of them by number.
//
// The loops are unrolled because counting costs as much as the arithmetic in loops this small.
//
// An operand is read by value(i); a scalar is loaded once, outside of the loop. The tape never lets a result
// share memory with an operand, which is what __restrict promises to the vectoriser.
template <class T, bool is_scalar>
struct Operand {
  PELAGE_TARGET explicit Operand(const T* data) : values(data) {}
  PELAGE_TARGET T operator[](std::size_t i) const { return values[i]; }
  const T* __restrict values;
};
template <class T>
struct Operand<T, true> {
  PELAGE_TARGET explicit Operand(const T* data) : value(*data) {}
  PELAGE_TARGET T operator[](std::size_t) const { return value; }
  T value;
};

template <class T, Op op, unsigned mask>
PELAGE_TARGET void loop(const T* a, const T* b, const T* c, T* __restrict out, std::size_t count) {
  const Operand<T, (mask & 1u) != 0> x(a);
  if constexpr (arity(op) == 1) {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], T{}, T{});
  } else if constexpr (arity(op) == 2) {
    const Operand<T, (mask & 2u) != 0> y(b);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], y[i], T{});
  } else if constexpr (arity(op) == 3) {
    const Operand<T, (mask & 2u) != 0> y(b);
    const Operand<T, (mask & 4u) != 0> z(c);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(x[i], y[i], z[i]);
  }
}

template <class T, Op inner, Op op, bool inner_last, unsigned mask>
PELAGE_TARGET void fused_loop(const T* a, const T* b, const T* c, T* __restrict out, std::size_t count) {
  const Operand<T, (mask & 1u) != 0> x(a);
  const Operand<T, (mask & 2u) != 0> y(b);
  const Operand<T, (mask & 4u) != 0> z(c);
#pragma GCC unroll 8
  for (std::size_t i = 0; i < count; ++i) {
    const T first = apply<inner>(x[i], y[i], T{});
    out[i] = inner_last ? apply<op>(z[i], first, T{}) : apply<op>(first, z[i], T{});
  }
}

template <class T, bool from_scalar>
PELAGE_TARGET void copy(const T* a, const T*, const T*, T* __restrict out, std::size_t count) {
  const Operand<T, from_scalar> x(a);
#pragma GCC unroll 8
  for (std::size_t i = 0; i < count; ++i) out[i] = x[i];
}

/// The loops of one operation; those of masks that it has no operands for are empty.
template <class T, Op op, unsigned mask>
constexpr TapeKernel<T> loop_or_none() {
  if constexpr (arity(op) > 0 && mask < (1u << arity(op)))
    return &loop<T, op, mask>;
  else
    return nullptr;
}

template <class T, std::size_t number>
constexpr TapeKernel<T> numbered() {
  if constexpr (number < first_fused) {
    return loop_or_none<T, static_cast<Op>(number / 8), static_cast<unsigned>(number % 8)>();
  } else if constexpr (number < first_copy) {
    constexpr std::size_t k = number - first_fused;
    return &fused_loop<T, fusible[k / 48], fusible[k / 16 % 3], (k / 8 % 2) != 0, static_cast<unsigned>(k % 8)>;
  } else {
    return &copy<T, number != first_copy>;
  }
}

template <class T, std::size_t... I>
constexpr std::array<TapeKernel<T>, sizeof...(I)> make_table(std::index_sequence<I...>) {
  return {numbered<T, I>()...};
}

template <class T>
constexpr auto table = make_table<T>(std::make_index_sequence<kernel_count>{});
