#pragma once
// The inner loops of Tape: out[i] = op(a[i], b[i], c[i]), where operands may be scalars. They have numbers, which are
// the same in double and in single precision and for every instruction set.

#include <cstddef>

#include "base/instruction_set.h"
#include "react/operations.h"

namespace pelage {

template <class T>
using TapeKernel = void (*)(const T* a, const T* b, const T* c, T* out, std::size_t count);

using KernelNumber = std::size_t;

/// All loops by number.
const TapeKernel<double>* double_kernels();
const TapeKernel<float>* float_kernels(InstructionSet set);

/// The loop for an operation; bit k of `scalar_mask` says that operand k is one number for all samples.
KernelNumber tape_kernel(Op op, unsigned scalar_mask);

/// Two operations in one loop, which saves storing the value between them: c op (a inner b) if `inner_last`,
/// otherwise (a inner b) op c. Both operations must be fusible. Rounded twice, like the two loops.
KernelNumber fused_kernel(Op inner, Op op, bool inner_last, unsigned scalar_mask);
constexpr bool is_fusible(Op op) { return op == Op::add || op == Op::subtract || op == Op::multiply; }

/// out[i] = a[i], or a[0] everywhere.
KernelNumber copy_kernel(bool from_scalar);

}  // namespace pelage
