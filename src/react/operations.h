#pragma once
// The operations of the formula language on numbers. Logical values are 0 and 1; anything but 0 is true.

#include <cmath>
#include <cstdint>
#include <limits>

namespace pelage {

enum class Op : std::uint8_t {
  constant,
  symbol,
  add,
  subtract,
  multiply,
  divide,
  negate,
  power,
  minimum,
  maximum,
  modulo,
  absolute,
  floor,
  exponential,
  logarithm,
  square_root,
  sine,
  cosine,
  tangent,
  hyperbolic_tangent,
  less,
  less_equal,
  equal,
  logical_and,
  logical_or,
  logical_not,
  select,          ///< select(condition, if true, if false); both branches are evaluated
  error_function,  ///< erf
  count            ///< number of operations
};

/// Whether values jump where operands do not.
constexpr bool has_jumps(Op op) {
  switch (op) {
    case Op::modulo:
    case Op::floor:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::logical_and:
    case Op::logical_or:
    case Op::logical_not:
    case Op::select:
      return true;
    default:
      return false;
  }
}

/// Number of operands.
constexpr int arity(Op op) {
  switch (op) {
    case Op::constant:
    case Op::symbol:
    case Op::count:
      return 0;
    case Op::negate:
    case Op::absolute:
    case Op::floor:
    case Op::exponential:
    case Op::logarithm:
    case Op::square_root:
    case Op::sine:
    case Op::cosine:
    case Op::tangent:
    case Op::hyperbolic_tangent:
    case Op::error_function:
    case Op::logical_not:
      return 1;
    case Op::select:
      return 3;
    default:
      return 2;
  }
}

constexpr bool is_commutative(Op op) { return op == Op::add || op == Op::multiply || op == Op::equal; }

/// The value of one operation. IEEE rules: never traps; min and max pass on a NaN in their first operand, so
/// that max(u, 0) does not hide a blow-up.
template <Op op, class T>
T apply([[maybe_unused]] T a, [[maybe_unused]] T b, [[maybe_unused]] T c) {
  if constexpr (op == Op::add) return a + b;
  if constexpr (op == Op::subtract) return a - b;
  if constexpr (op == Op::multiply) return a * b;
  if constexpr (op == Op::divide) return a / b;
  if constexpr (op == Op::negate) return -a;
  if constexpr (op == Op::power) return std::pow(a, b);
  if constexpr (op == Op::minimum) return b < a ? b : a;
  if constexpr (op == Op::maximum) return b > a ? b : a;
  if constexpr (op == Op::modulo) return a - b * std::floor(a / b);
  if constexpr (op == Op::absolute) return std::fabs(a);
  if constexpr (op == Op::floor) return std::floor(a);
  if constexpr (op == Op::exponential) return std::exp(a);
  if constexpr (op == Op::logarithm) return std::log(a);
  if constexpr (op == Op::square_root) return std::sqrt(a);
  if constexpr (op == Op::sine) return std::sin(a);
  if constexpr (op == Op::cosine) return std::cos(a);
  if constexpr (op == Op::tangent) return std::tan(a);
  if constexpr (op == Op::hyperbolic_tangent) return std::tanh(a);
  if constexpr (op == Op::error_function) return std::erf(a);
  if constexpr (op == Op::less) return a < b ? T{1} : T{0};
  if constexpr (op == Op::less_equal) return a <= b ? T{1} : T{0};
  if constexpr (op == Op::equal) return a == b ? T{1} : T{0};
  if constexpr (op == Op::logical_and) return ((a != 0) & (b != 0)) ? T{1} : T{0};
  if constexpr (op == Op::logical_or) return ((a != 0) | (b != 0)) ? T{1} : T{0};
  if constexpr (op == Op::logical_not) return a == 0 ? T{1} : T{0};
  if constexpr (op == Op::select) return a != 0 ? b : c;
  return std::numeric_limits<T>::quiet_NaN();  // constants and symbols have no operands
}

/// The same for an operation known at run time.
double apply(Op op, double a, double b, double c);

}  // namespace pelage
