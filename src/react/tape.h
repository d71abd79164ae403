#pragma once
// Expressions compiled to a straight-line program over registers, run in blocks of samples: each instruction
// is one loop over a block, which the compiler vectorises, and the registers of a block stay in the L1 cache.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

  std::size_t instruction_count() const { return instructions_.size(); }
  std::size_t register_count() const { return register_count_; }

 private:
  friend class TapeBuilder;
  using Kernel = void (*)(const double* a, const double* b, const double* c, double* out, std::size_t count);
  struct Instruction {
    Kernel kernel = nullptr;
    std::uint32_t out = 0;  ///< places of the operands and of the result in the table of pointers, which holds
    std::uint32_t in[3] = {0, 0, 0};  ///< registers, then inputs, outputs, scalars, constants
  };

  std::size_t register_count_ = 0, input_count_ = 0, output_count_ = 0, scalar_count_ = 0;
  std::vector<double> constants_;
  std::vector<Instruction> instructions_;
};

}  // namespace pelage
