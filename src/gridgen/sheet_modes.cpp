#include "gridgen/sheet_modes.h"

#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace pelage {

namespace {

std::vector<double> transposed(const std::vector<double>& matrix, std::size_t n) {
  std::vector<double> result(matrix.size());
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) result[j * n + i] = matrix[i * n + j];
  return result;
}

/// to[0..n) += the sum over k of weight[k] * rows[k * n ..], four rows at a time to spare memory.
void add_rows(const double* weight, std::size_t stride, std::size_t count, const double* rows, std::size_t n,
              double* to) {
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const double a = weight[k * stride], b = weight[(k + 1) * stride], c = weight[(k + 2) * stride],
                 d = weight[(k + 3) * stride];
    const double *p = rows + k * n, *q = p + n, *r = q + n, *s = r + n;
    for (std::size_t i = 0; i < n; ++i) to[i] += (a * p[i] + b * q[i]) + (c * r[i] + d * s[i]);
  }
  for (; k < count; ++k)
    for (std::size_t i = 0; i < n; ++i) to[i] += weight[k * stride] * rows[k * n + i];
}

}  // namespace

SheetModes::Axis SheetModes::sines(std::int32_t count) {
  Axis axis{count, {}, {}, {}};
  for (std::int32_t mode = 1; mode <= count; ++mode) {
    const double step = std::numbers::pi * mode / (count + 1);
    axis.values.push_back(2 - 2 * std::cos(step));
    for (std::int32_t i = 1; i <= count; ++i) axis.rows.push_back(std::sqrt(2.0 / (count + 1)) * std::sin(step * i));
  }
  axis.columns = transposed(axis.rows, static_cast<std::size_t>(count));
  return axis;
}

SheetModes::Axis SheetModes::circle(std::int32_t count) {
  Axis axis{count, {}, {}, {}};
  for (std::int32_t mode = 0; mode < count; ++mode) {
    const std::int32_t waves = (mode + 1) / 2;
    const double step = 2 * std::numbers::pi * waves / count;
    axis.values.push_back(2 - 2 * std::cos(step));
    const double height = std::sqrt((waves == 0 || 2 * waves == count ? 1.0 : 2.0) / count);
    for (std::int32_t i = 0; i < count; ++i)
      axis.rows.push_back(height * (mode % 2 ? std::cos(step * i) : mode ? std::sin(step * i) : 1));
  }
  axis.columns = transposed(axis.rows, static_cast<std::size_t>(count));
  return axis;
}

SheetModes::SheetModes(const Sheet& sheet, double along, double across)
    : sheet_(sheet),
      along_(sheet.ring ? circle(sheet.count[0]) : sines(sheet.count[0] - 2)),
      across_(sines(sheet.count[1] - 2)),
      inner_(along_.values.size() * across_.values.size()) {
  for (const double b : across_.values)
    for (const double a : along_.values) scale_.push_back(1 / std::sqrt(a / (along * along) + b / (across * across)));
}

std::size_t SheetModes::node(std::size_t i, std::size_t j) const {
  return sheet_.node(static_cast<std::int32_t>(i) + (sheet_.ring ? 0 : 1), static_cast<std::int32_t>(j) + 1);
}

std::vector<double> SheetModes::transformed(const std::vector<double>& x, const std::vector<double>& along,
                                            const std::vector<double>& across) const {
  const std::size_t n = along_.values.size(), m = across_.values.size();
  std::vector<double> half(inner_), result(inner_);
  parallel_for(
      m,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) add_rows(&x[j * n], 1, n, along.data(), n, &half[j * n]);
      },
      8);
  parallel_for(
      m,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) add_rows(&across[j], m, m, half.data(), n, &result[j * n]);
      },
      8);
  return result;
}

void SheetModes::displace(const std::vector<double>& amplitudes, std::vector<Point>& nodes) const {
  const std::size_t n = along_.values.size();
  std::vector<double> x(inner_);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < inner_; ++i) x[i] = scale_[i] * amplitudes[k * inner_ + i];
    const std::vector<double> moved = transformed(x, along_.rows, across_.rows);
    for (std::size_t i = 0; i < inner_; ++i) nodes[node(i % n, i / n)][k] += moved[i];
  }
}

void SheetModes::gradient(const std::vector<Point>& by_nodes, std::vector<double>& by_amplitudes) const {
  const std::size_t n = along_.values.size();
  std::vector<double> x(inner_);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < inner_; ++i) x[i] = by_nodes[node(i % n, i / n)][k];
    const std::vector<double> modes = transformed(x, along_.columns, across_.columns);
    for (std::size_t i = 0; i < inner_; ++i) by_amplitudes[k * inner_ + i] = scale_[i] * modes[i];
  }
}

}  // namespace pelage
