#pragma once
// Inner loops that are compiled once per instruction set and chosen at run time. As multiplications and additions are
// never fused, and every sum has an order of its own, all give the same bits.

#include <span>

namespace pelage {

enum class InstructionSet { baseline, avx2, avx512 };

/// Those that this build and this processor have, the plainest first.
std::span<const InstructionSet> instruction_sets();

inline InstructionSet best_instruction_set() { return instruction_sets().back(); }

}  // namespace pelage
