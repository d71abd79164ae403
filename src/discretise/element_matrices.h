#pragma once
// Sparse matrices as sums of the matrices of elements, whatever these are made of. Parallel and deterministic: element
// matrices are computed in any order, every row is summed in the order of elements.

#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "base/parallel.h"
#include "linalg/sparse.h"
#include "shape/topology.h"

namespace pelage {

/// Where the entries of all element matrices go, made once and used for every sum.
/// Memory: 2 bytes per entry of all element matrices (288 bytes per regular Loop triangle) besides the pattern; 4 if a
/// row could be longer than 16 bits can count.
class ElementMatrices {
 public:
  /// The functions of element e are function[first_function[e]] up to function[first_function[e + 1]]. Keeps references
  /// to both.
  ElementMatrices(Index unknowns, const std::vector<std::int64_t>& first_function, const std::vector<Index>& function);

  const std::shared_ptr<const SparsePattern>& pattern() const { return pattern_; }

  /// `fill(e, scratch, out)` adds to the matrices out[k] of element e, row by row, which come as zeros; `scratch` is
  /// its own work space in every thread.
  template <std::size_t count, class Scratch, class Fill>
  std::array<SparseMatrix, count> sum(const Fill& fill) const;

 private:
  std::size_t elements() const { return first_function_.size() - 1; }
  bool rows_are_short(const struct FunctionElements& incident) const;
  template <class Offset>
  void build(const FunctionElements& incident, std::vector<Offset>& offset);
  template <class Offset>
  void build_rows(Index begin, Index end, const FunctionElements& incident, SparsePattern& part,
                  std::vector<Offset>& offset) const;
  template <std::size_t count>
  void add(std::size_t e, const std::array<const double*, count>& matrix, std::size_t owner, std::size_t owners,
           std::array<SparseMatrix, count>& result) const;

  Index unknowns_;
  const std::vector<std::int64_t>& first_function_;
  const std::vector<Index>& function_;
  std::shared_ptr<const SparsePattern> pattern_;
  std::vector<std::int64_t> matrix_start_;  ///< per element + 1: where its matrix begins in offset_
  /// Of an element matrix' entry within its row of the pattern.
  std::variant<std::vector<std::uint16_t>, std::vector<std::uint32_t>> offset_;
};

/// Adds the rows of one element's matrices that belong to `owner`.
template <std::size_t count>
void ElementMatrices::add(std::size_t e, const std::array<const double*, count>& matrix, std::size_t owner,
                          std::size_t owners, std::array<SparseMatrix, count>& result) const {
  constexpr std::size_t row_block = 64;  // rows are dealt to the threads in blocks, so that near rows stay together
  const Index* function = function_.data() + first_function_[e];
  const auto n = static_cast<std::size_t>(first_function_[e + 1] - first_function_[e]);
  std::visit(
      [&](const auto& offsets) {
        const auto* offset = offsets.data() + matrix_start_[e];
        for (std::size_t i = 0; i < n; ++i) {
          const auto row_number = static_cast<std::size_t>(function[i]);
          if (row_number / row_block % owners != owner) continue;
          const auto start = pattern_->start[row_number];
          for (std::size_t k = 0; k < count; ++k) {
            double* row = result[k].value.data() + start;
            for (std::size_t j = 0; j < n; ++j) row[offset[i * n + j]] += matrix[k][i * n + j];
          }
        }
      },
      offset_);
}

template <std::size_t count, class Scratch, class Fill>
std::array<SparseMatrix, count> ElementMatrices::sum(const Fill& fill) const {
  std::array<SparseMatrix, count> result;
  for (SparseMatrix& matrix : result) matrix = zeros(pattern_);
  // Element matrices are kept for one chunk at a time: 16 MB for regular Loop elements.
  constexpr std::size_t chunk = (1 << 14) / count;
  const auto owners = static_cast<std::size_t>(concurrency());
  std::array<std::vector<double>, count> buffer;
  for (std::size_t first = 0; first < elements(); first += chunk) {
    const std::size_t last = std::min(elements(), first + chunk);
    const auto place = [&](std::size_t e) { return matrix_start_[e] - matrix_start_[first]; };
    for (auto& b : buffer) b.resize(static_cast<std::size_t>(place(last)));
    parallel_for(
        last - first,
        [&](std::size_t begin, std::size_t end) {
          Scratch scratch;
          std::array<double*, count> out;
          for (std::size_t e = first + begin; e < first + end; ++e) {
            for (std::size_t k = 0; k < count; ++k) {
              out[k] = buffer[k].data() + place(e);
              std::fill_n(out[k], place(e + 1) - place(e), 0.0);
            }
            fill(e, scratch, out);
          }
        },
        256);
    parallel_chunks(owners, [&](std::size_t owner) {
      std::array<const double*, count> matrix;
      for (std::size_t e = first; e < last; ++e) {
        for (std::size_t k = 0; k < count; ++k) matrix[k] = buffer[k].data() + place(e);
        add(e, matrix, owner, owners, result);
      }
    });
  }
  return result;
}

}  // namespace pelage
