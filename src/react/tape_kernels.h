#pragma once
// The inner loops of Tape: out[i] = op(a[i], b[i], c[i]), where operands may be scalars.

#include <cstddef>

#include "react/operations.h"

namespace pelage {

using TapeKernel = void (*)(const double* a, const double* b, const double* c, double* out, std::size_t count);

/// The loop for an operation; bit k of `scalar_mask` says that operand k is one number for all samples.
TapeKernel tape_kernel(Op op, unsigned scalar_mask);

/// out[i] = a[i], or a[0] everywhere.
TapeKernel copy_kernel(bool from_scalar);

}  // namespace pelage
