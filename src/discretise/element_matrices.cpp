#include "discretise/element_matrices.h"

#include <algorithm>
#include <limits>

namespace pelage {

/// Elements that contain each basis function, with its local number there.
struct FunctionElements {
  std::vector<std::int64_t> start;
  std::vector<std::pair<Index, Index>> element;  // element, local number; elements ascending
};

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

FunctionElements function_elements(Index unknowns, const std::vector<std::int64_t>& first,
                                   const std::vector<Index>& function) {
  FunctionElements result;
  result.start.assign(at(unknowns) + 1, 0);
  for (Index f : function) ++result.start[at(f) + 1];
  for (std::size_t i = 1; i < result.start.size(); ++i) result.start[i] += result.start[i - 1];
  result.element.resize(function.size());
  std::vector<std::int64_t> cursor(result.start.begin(), result.start.end() - 1);
  for (std::size_t e = 0; e + 1 < first.size(); ++e)
    for (std::int64_t k = first[e]; k < first[e + 1]; ++k)
      result.element[at(cursor[at(function[at(k)])]++)] = {static_cast<Index>(e), static_cast<Index>(k - first[e])};
  return result;
}

}  // namespace

/// Do 16 bits number the entries of every row? The matrices that meet in a row bound its length.
bool ElementMatrices::rows_are_short(const FunctionElements& incident) const {
  constexpr std::int64_t longest = std::int64_t{std::numeric_limits<std::uint16_t>::max()} + 1;
  if (unknowns_ <= longest) return true;
  for (std::size_t row = 0; row + 1 < incident.start.size(); ++row) {
    std::int64_t length = 0;
    for (auto k = incident.start[row]; k < incident.start[row + 1]; ++k) {
      const std::size_t e = at(incident.element[at(k)].first);
      length += first_function_[e + 1] - first_function_[e];
    }
    if (length > longest) return false;
  }
  return true;
}

template <class Offset>
void ElementMatrices::build_rows(Index begin, Index end, const FunctionElements& incident, SparsePattern& part,
                                 std::vector<Offset>& offset) const {
  std::vector<Index> rank(at(unknowns_), -1);  // of a column in the current row
  std::vector<Index> columns;
  for (Index row = begin; row < end; ++row) {
    columns.clear();
    const auto first = incident.start[at(row)], last = incident.start[at(row) + 1];
    auto for_each_column = [&](auto visit) {
      for (auto k = first; k < last; ++k) {
        const auto [e, local] = incident.element[at(k)];
        for (auto c = first_function_[at(e)]; c < first_function_[at(e) + 1]; ++c)
          visit(function_[at(c)], at(e), local, c - first_function_[at(e)]);
      }
    };
    for_each_column([&](Index column, std::size_t, Index, std::int64_t) {
      if (rank[at(column)] == -1) columns.push_back(column);
      rank[at(column)] = 0;
    });
    std::sort(columns.begin(), columns.end());
    for (std::size_t k = 0; k < columns.size(); ++k) rank[at(columns[k])] = static_cast<Index>(k);
    for_each_column([&](Index column, std::size_t e, Index local, std::int64_t other) {
      const std::int64_t n = first_function_[e + 1] - first_function_[e];
      offset[at(matrix_start_[e] + local * n + other)] = static_cast<Offset>(rank[at(column)]);
    });
    for (Index column : columns) rank[at(column)] = -1;
    part.column.insert(part.column.end(), columns.begin(), columns.end());
    part.start.push_back(static_cast<std::int64_t>(part.column.size()));
  }
}

ElementMatrices::ElementMatrices(Index unknowns, const std::vector<std::int64_t>& first_function,
                                 const std::vector<Index>& function)
    : unknowns_(unknowns), first_function_(first_function), function_(function) {
  const FunctionElements incident = function_elements(unknowns, first_function, function);
  matrix_start_.push_back(0);
  for (std::size_t e = 0; e < elements(); ++e) {
    const std::int64_t n = first_function_[e + 1] - first_function_[e];
    matrix_start_.push_back(matrix_start_.back() + n * n);
  }
  if (!rows_are_short(incident)) offset_.emplace<std::vector<std::uint32_t>>();
  std::visit([&](auto& offset) { build(incident, offset); }, offset_);
}

template <class Offset>
void ElementMatrices::build(const FunctionElements& incident, std::vector<Offset>& offset) {
  offset.resize(at(matrix_start_.back()));
  const auto parts_count = static_cast<std::size_t>(concurrency());
  std::vector<SparsePattern> parts(parts_count);
  const auto rows_per_part = static_cast<Index>((at(unknowns_) + parts_count - 1) / parts_count);
  parallel_chunks(parts_count, [&](std::size_t p) {
    const Index begin = std::min(unknowns_, static_cast<Index>(p) * rows_per_part);
    build_rows(begin, std::min(unknowns_, begin + rows_per_part), incident, parts[p], offset);
  });
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = unknowns_;
  for (const SparsePattern& part : parts) {
    const auto base = static_cast<std::int64_t>(pattern->column.size());
    for (std::size_t r = 1; r < part.start.size(); ++r) pattern->start.push_back(base + part.start[r]);
    pattern->column.insert(pattern->column.end(), part.column.begin(), part.column.end());
  }
  pattern_ = std::move(pattern);
}

}  // namespace pelage
