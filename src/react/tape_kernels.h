#pragma once
// The inner loops of Tape: out[i] = op(a[i], b[i], c[i]), where operands may be scalars.

#include <cstddef>

#include "react/operations.h"

namespace pelage {

using TapeKernel = void (*)(const double* a, const double* b, const double* c, double* out, std::size_t count);

/// The loop for an operation; bit k of `scalar_mask` says that operand k is one number for all samples.
TapeKernel tape_kernel(Op op, unsigned scalar_mask);

/// Two operations in one loop, which saves storing the value between them: c op (a inner b) if `inner_last`,
/// otherwise (a inner b) op c. Both operations must be fusible. Rounded twice, like the two loops.
TapeKernel fused_kernel(Op inner, Op op, bool inner_last, unsigned scalar_mask);
constexpr bool is_fusible(Op op) { return op == Op::add || op == Op::subtract || op == Op::multiply; }

/// out[i] = a[i], or a[0] everywhere.
TapeKernel copy_kernel(bool from_scalar);

}  // namespace pelage
