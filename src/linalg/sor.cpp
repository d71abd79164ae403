#include "linalg/sor.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// (b - A x) of a row.
double row_residual(const SparseMatrix& a, std::int32_t row, const Vector& b, const Vector& x) {
  double sum = b[row];
  for (auto k = a.pattern->start[at(row)]; k < a.pattern->start[at(row) + 1]; ++k)
    sum -= a.value[at(k)] * x[a.pattern->column[at(k)]];
  return sum;
}

double residual(const SparseMatrix& a, const Vector& b, const Vector& x, const Held* held) {
  return std::sqrt(ordered_sum(at(b.size()), 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i)
      if (!held || !(*held)[i]) sum += std::pow(row_residual(a, static_cast<std::int32_t>(i), b, x), 2);
    return sum;
  }));
}

}  // namespace

SweepColours::SweepColours(const SparsePattern& pattern) {
  std::vector<std::size_t> colour(at(pattern.rows));
  std::vector<char> taken;
  for (std::int32_t i = 0; i < pattern.rows; ++i) {
    taken.assign(colours_.size() + 1, 0);
    for (auto k = pattern.start[at(i)]; k < pattern.start[at(i) + 1]; ++k)
      if (const std::int32_t j = pattern.column[at(k)]; j < i) taken[colour[at(j)]] = 1;
    colour[at(i)] = at(std::ranges::find(taken, 0) - taken.begin());
    if (colour[at(i)] == colours_.size()) colours_.emplace_back();
    colours_[colour[at(i)]].push_back(i);
  }
}

SweepColours SweepColours::lexicographic(const SparsePattern& pattern) {
  SweepColours all;
  all.in_order_ = true;
  all.colours_.emplace_back(at(pattern.rows));
  std::iota(all.colours_[0].begin(), all.colours_[0].end(), 0);
  return all;
}

SolveReport successive_over_relaxation(const SparseMatrix& a, const SweepColours& colours, const Vector& b, Vector& x,
                                       const Held* held, const SorOptions& options) {
  const Vector of_diagonal = diagonal(a);
  const auto relax = [&](const std::vector<std::int32_t>& rows, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (const std::int32_t i = rows[k]; !held || !(*held)[at(i)])
        x[i] += options.relaxation * row_residual(a, i, b, x) / of_diagonal[i];
  };
  SolveReport report;
  // Held values alone may drive the others: then their first residual is the measure.
  const double scale = norm(b) > 0 ? norm(b) : residual(a, b, x, held);
  constexpr int sweeps_between = 10;
  while (true) {
    if (report.iterations % sweeps_between == 0 || report.iterations == options.max_iterations) {
      report.residual = scale > 0 ? residual(a, b, x, held) / scale : 0;
      report.converged = report.residual <= options.tolerance;
      if (report.converged || report.iterations >= options.max_iterations || !std::isfinite(report.residual))
        return report;
    }
    for (std::size_t c = 0; c < colours.count(); ++c) {
      const std::vector<std::int32_t>& rows = colours.rows(c);
      if (colours.in_order())
        relax(rows, 0, rows.size());
      else
        parallel_for(rows.size(), [&](std::size_t begin, std::size_t end) { relax(rows, begin, end); });
    }
    ++report.iterations;
  }
}

}  // namespace pelage
