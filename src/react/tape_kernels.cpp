#include "react/tape_kernels.h"

#include <array>
#include <utility>

namespace pelage {

namespace {

// Numbers of loops: [op][mask], then the fused ones [inner][op][inner_last][mask], then the two copies.
constexpr std::size_t first_fused = static_cast<std::size_t>(Op::count) * 8;
constexpr std::size_t first_copy = first_fused + std::size_t{3} * 3 * 2 * 8;
constexpr std::size_t kernel_count = first_copy + 2;

constexpr std::array<Op, 3> fusible = {Op::add, Op::subtract, Op::multiply};

std::size_t fusible_number(Op op) { return op == Op::add ? 0 : op == Op::subtract ? 1 : 2; }

#define PELAGE_LOOPS "react/tape_loops.h"
#include "base/each_instruction_set.h"

}  // namespace

KernelNumber fused_kernel(Op inner, Op op, bool inner_last, unsigned scalar_mask) {
  return first_fused + ((fusible_number(inner) * 3 + fusible_number(op)) * 2 + (inner_last ? 1 : 0)) * 8 + scalar_mask;
}

KernelNumber tape_kernel(Op op, unsigned scalar_mask) { return static_cast<std::size_t>(op) * 8 + scalar_mask; }

KernelNumber copy_kernel(bool from_scalar) { return first_copy + (from_scalar ? 1 : 0); }

const TapeKernel<double>* double_kernels() { return baseline::table<double>.data(); }

const TapeKernel<float>* float_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx2:
      return avx2::table<float>.data();
    case InstructionSet::avx512:
      return avx512::table<float>.data();
    default:
      return baseline::table<float>.data();
  }
}

}  // namespace pelage
