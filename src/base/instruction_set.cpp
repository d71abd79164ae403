#include "base/instruction_set.h"

#include <vector>

namespace pelage {

std::span<const InstructionSet> instruction_sets() {
  static const std::vector<InstructionSet> sets = [] {
    std::vector<InstructionSet> found = {InstructionSet::baseline};
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2")) found.push_back(InstructionSet::avx2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
      found.push_back(InstructionSet::avx512);
#endif
    return found;
  }();
  return sets;
}

}  // namespace pelage
