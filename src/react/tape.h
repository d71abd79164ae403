#pragma once
// Expressions compiled to a straight-line program over registers, run in blocks of samples: each instruction
// is one loop over a block, which the compiler vectorises, and the registers of a block stay in the L1 cache.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/instruction_set.h"
#include "react/expression.h"

namespace pelage {

class Tape {
 public:
  Tape() = default;
  /// A program for the values of `roots`. `inputs` are nodes whose values are given per sample, `scalars` nodes
  /// with one value per run; every symbol in the roots must lie in or below one of them. Small integer powers
  /// should have been written as products (expand_powers).
  Tape(const Graph& graph, std::span<const NodeId> roots, std::span<const NodeId> inputs,
       std::span<const NodeId> scalars);

  /// out[r][i] = value of root r at sample i, for begin <= i < end. inputs[k][i] is the value of input k at
  /// sample i, scalars[k] that of scalar k. Outputs must not overlap inputs or each other. Thread-safe; the
  /// result for a sample does not depend on begin and end.
  void run(std::span<const double* const> inputs, std::span<const double> scalars, std::size_t begin, std::size_t end,
           std::span<double* const> out) const;

  /// The same in single precision for samples [0, count).
  void run(std::span<const float* const> inputs, std::span<const float> scalars, std::size_t count,
           std::span<float* const> out, InstructionSet set = best_instruction_set()) const;

  std::size_t instruction_count() const { return instructions_.size(); }
  std::size_t register_count() const { return register_count_; }

 private:
  friend class TapeBuilder;
  struct Instruction {
    std::uint32_t kernel = 0;  ///< number, see react/tape_kernels.h
    std::uint32_t out = 0;     ///< places of the operands and of the result in the table of pointers, which holds
    std::uint32_t in[3] = {0, 0, 0};  ///< registers, then inputs, outputs, scalars, constants
  };

  template <class T, class Kernels>
  void execute(Kernels kernels, const std::vector<T>& constants, std::span<const T* const> inputs,
               std::span<const T> scalars, std::size_t begin, std::size_t end, std::span<T* const> out) const;

  std::size_t register_count_ = 0, input_count_ = 0, output_count_ = 0, scalar_count_ = 0;
  std::vector<double> constants_;
  std::vector<float> float_constants_;
  std::vector<Instruction> instructions_;
};

}  // namespace pelage
