#include "time/paired_nodes.h"

#include <algorithm>
#include <cstring>

#include "base/parallel.h"

namespace pelage {

namespace {

#define PELAGE_LOOPS "time/paired_loops.h"
#include "base/each_instruction_set.h"

bool diagonal_only(const SparseMatrix& a) {
  for (std::int32_t i = 0; i < a.rows(); ++i)
    for (auto k = a.pattern->start[i]; k < a.pattern->start[i + 1]; ++k)
      if (a.pattern->column[k] != i && a.value[k] != 0) return false;
  return true;
}

/// Columns in 16 bits, if all lie so near.
void shorten(SlicedMatrix& m) {
  m.near.resize(m.column.size());
  for (std::size_t s = 0; s < m.slices(); ++s)
    for (std::size_t k = slice_rows * m.start[s]; k < slice_rows * m.start[s + 1]; ++k) {
      const auto distance = static_cast<std::ptrdiff_t>(m.column[k]) - static_cast<std::ptrdiff_t>(slice_rows * s);
      m.near[k] = static_cast<std::int16_t>(distance);
      if (m.near[k] == distance) continue;
      m.near.clear();
      return;
    }
  m.column.clear();
}

}  // namespace

SpeciesSums& SpeciesSums::operator+=(const SpeciesSums& o) {
  minimum = std::min(minimum, o.minimum);
  maximum = std::max(maximum, o.maximum);
  largest = std::max(largest, o.largest);
  deviation += o.deviation;
  squared_deviation += o.squared_deviation;
  squared_change += o.squared_change;
  return *this;
}

const NodeLoops& node_loops(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx2:
      return avx2::loops;
    case InstructionSet::avx512:
      return avx512::loops;
    default:
      return baseline::loops;
  }
}

SlicedMatrix slice(std::span<const SharedMatrix> stiffness, const SparseMatrix& mass, const Vector& lumped, double area,
                   const std::vector<char>* held, const std::vector<char>* given) {
  const SparsePattern& pattern = *stiffness[0]->pattern;
  const std::size_t count = stiffness.size();
  SlicedMatrix m;
  m.twin = count == 2;
  m.rows = static_cast<std::size_t>(pattern.rows);
  const bool corrected = !diagonal_only(mass);
  m.start.push_back(0);
  for (std::size_t row = 0; row < padded(m.rows); row += slice_rows) {
    std::int64_t longest = 0;
    for (std::size_t i = row; i < std::min(row + slice_rows, m.rows); ++i)
      longest = std::max(longest, pattern.start[i + 1] - pattern.start[i] - 1);
    m.start.push_back(m.start.back() + static_cast<std::size_t>(longest));
  }
  const std::size_t size = slice_rows * m.start.back();
  m.column.resize(size);
  m.diffusion.resize(count * size);
  if (corrected) m.correction.resize(size);
  parallel_for(
      m.slices(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s)
          for (std::size_t k = 0; k < slice_rows; ++k) {
            const std::size_t i = s * slice_rows + k;
            std::size_t at = slice_rows * m.start[s] + k;
            const bool moves = i < m.rows && !(held && (*held)[i]);
            const double scale = moves ? -1 / lumped[static_cast<Eigen::Index>(i)] : 0;
            if (i < m.rows)
              for (auto e = pattern.start[i]; e < pattern.start[i + 1]; ++e) {
                if (pattern.column[e] == static_cast<std::int32_t>(i)) continue;
                m.column[at] = pattern.column[e];
                for (std::size_t lane = 0; lane < count; ++lane)
                  m.diffusion[count * at + lane] = static_cast<float>(area * scale * stiffness[lane]->value[e]);
                const bool linked = !(given && (*given)[static_cast<std::size_t>(pattern.column[e])]);
                if (corrected) m.correction[at] = linked ? static_cast<float>(scale * mass.value[e]) : 0.0f;
                at += slice_rows;
              }
            for (; at < slice_rows * m.start[s + 1] + k; at += slice_rows)
              m.column[at] = static_cast<std::int32_t>(std::min(i, m.rows - 1));
          }
      },
      256);
  shorten(m);
  return m;
}

}  // namespace pelage
