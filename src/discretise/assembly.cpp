#include "discretise/assembly.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel.h"
#include "discretise/metric.h"

// One more version of a function for processors with AVX2, chosen when the program starts. Multiplications and
// additions are not fused there either.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define PELAGE_WIDER_REGISTERS __attribute__((target_clones("avx2", "default"), noinline))
#else
#define PELAGE_WIDER_REGISTERS
#endif

namespace pelage {

/// Elements that contain each basis function, with its local number there.
struct FunctionElements {
  std::vector<std::int64_t> start;
  std::vector<std::pair<Index, Index>> element;  // element, local number; elements ascending
};

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

FunctionElements function_elements(const Discretisation& d) {
  FunctionElements result;
  result.start.assign(at(d.unknowns) + 1, 0);
  for (Index f : d.function) ++result.start[at(f) + 1];
  for (std::size_t i = 1; i < result.start.size(); ++i) result.start[i] += result.start[i - 1];
  result.element.resize(d.function.size());
  std::vector<std::int64_t> cursor(result.start.begin(), result.start.end() - 1);
  for (std::size_t e = 0; e < d.elements(); ++e)
    for (std::int64_t k = d.first_function[e]; k < d.first_function[e + 1]; ++k) {
      const Index f = d.function[static_cast<std::size_t>(k)];
      result.element[static_cast<std::size_t>(cursor[at(f)]++)] = {static_cast<Index>(e),
                                                                   static_cast<Index>(k - d.first_function[e])};
    }
  return result;
}

/// weight * area * G^-1 [x_v x_w]' T [x_v x_w] G^-1.
Form gradient_form(const Metric& m, double weight, const Tensor& t) {
  if (!(m.area > 0)) return {0, 0, 0};
  Eigen::Matrix3d tensor;
  tensor << t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5];
  const Form inverse = gradient_form(m, 1 / m.area);                // G^-1
  const Eigen::Vector3d v = inverse.vv * m.xv + inverse.vw * m.xw;  // dual tangents
  const Eigen::Vector3d w = inverse.vw * m.xv + inverse.ww * m.xw;
  const double scale = weight * m.area;
  return {scale * v.dot(tensor * v), scale * v.dot(tensor * w), scale * w.dot(tensor * w)};
}

/// out(i, j) += sum over q of left(q, i) right(q, j), all row by row.
void add_product(const double* left, const double* right, Index functions, Index points, double* out) {
  for (Index i = 0; i < functions; ++i)
    for (Index j = 0; j < functions; ++j) {
      double sum = 0;
      for (Index q = 0; q < points; ++q) sum += left[q * functions + i] * right[q * functions + j];
      out[i * functions + j] += sum;
    }
}

/// The same, with the same bits, for sizes known to the compiler, which keeps the sums of a row in registers.
template <int functions, int points>
inline void add_product_fixed(const double* __restrict left, const double* __restrict right, double* __restrict out) {
  for (int i = 0; i < functions; ++i) {
    double sum[functions] = {};
    for (int q = 0; q < points; ++q) {
      const double factor = left[q * functions + i];
      for (int j = 0; j < functions; ++j) sum[j] += factor * right[q * functions + j];
    }
    for (int j = 0; j < functions; ++j) out[i * functions + j] += sum[j];
  }
}

/// The same for elements with an extraordinary corner, up to a number of functions whose sums stay in the cache.
constexpr Index most_functions_at_once = 64;
PELAGE_WIDER_REGISTERS void add_product_by_rows(const double* __restrict left, const double* __restrict right,
                                                Index functions, Index points, double* __restrict out) {
  for (Index i = 0; i < functions; ++i) {
    double sum[most_functions_at_once] = {};
    for (Index q = 0; q < points; ++q) {
      const double factor = left[q * functions + i];
      for (Index j = 0; j < functions; ++j) sum[j] += factor * right[q * functions + j];
    }
    for (Index j = 0; j < functions; ++j) out[i * functions + j] += sum[j];
  }
}

/// Wider registers hold more functions at a time; each sum has the same bits.
PELAGE_WIDER_REGISTERS void add_product_regular(const double* left, const double* right, double* out) {
  add_product_fixed<12, 6>(left, right, out);
}

}  // namespace

void add_basis_product(const RowMatrix& left, const double* right, double* out) {
  const auto functions = static_cast<Index>(left.cols()), points = static_cast<Index>(left.rows());
  if (functions == 12 && points == 6)  // regular Loop elements
    add_product_regular(left.data(), right, out);
  else if (functions <= most_functions_at_once)
    add_product_by_rows(left.data(), right, functions, points, out);
  else
    add_product(left.data(), right, functions, points, out);
}

void add_basis_product_plain(const RowMatrix& left, const double* right, double* out) {
  add_product(left.data(), right, static_cast<Index>(left.cols()), static_cast<Index>(left.rows()), out);
}

namespace {

/// Work space of one thread, grown to the largest element.
struct Scratch {
  std::vector<double> first, second;
  std::vector<Form> form;
  std::vector<double> scale;

  void fit(const ElementClass& c) {
    const auto size = static_cast<std::size_t>(c.value.size());
    if (first.size() < size) {
      first.resize(size);
      second.resize(size);
    }
    form.resize(at(c.points()));
    scale.resize(at(c.points()));
  }
};

/// out = B' W B with scratch.scale.
void mass_matrix(const ElementClass& c, Scratch& scratch, double* out) {
  const Index n = c.functions();
  for (Index q = 0; q < c.points(); ++q)
    for (Index i = 0; i < n; ++i) scratch.first[at(q * n + i)] = scratch.scale[at(q)] * c.value.data()[q * n + i];
  add_basis_product(c.value, scratch.first.data(), out);
}

/// out = [G_v G_w]' F [G_v G_w] with scratch.form.
void stiffness_matrix(const ElementClass& c, Scratch& scratch, double* out) {
  const Index n = c.functions();
  for (Index q = 0; q < c.points(); ++q) {
    const Form& f = scratch.form[at(q)];
    const double *dv = c.dv.data() + q * n, *dw = c.dw.data() + q * n;
    double *first = scratch.first.data() + q * n, *second = scratch.second.data() + q * n;
    for (Index i = 0; i < n; ++i) {
      first[i] = f.vv * dv[i] + f.vw * dw[i];
      second[i] = f.vw * dv[i] + f.ww * dw[i];
    }
  }
  add_basis_product(c.dv, scratch.first.data(), out);
  add_basis_product(c.dw, scratch.second.data(), out);
}

}  // namespace

namespace {

/// Do 16 bits number the entries of every row? The matrices that meet in a row bound its length.
bool rows_are_short(const Discretisation& d, const FunctionElements& incident) {
  constexpr std::int64_t longest = std::int64_t{std::numeric_limits<std::uint16_t>::max()} + 1;
  if (d.unknowns <= longest) return true;
  for (std::size_t row = 0; row + 1 < incident.start.size(); ++row) {
    std::int64_t length = 0;
    for (auto k = incident.start[row]; k < incident.start[row + 1]; ++k) {
      const std::size_t e = at(incident.element[static_cast<std::size_t>(k)].first);
      length += d.first_function[e + 1] - d.first_function[e];
    }
    if (length > longest) return false;
  }
  return true;
}

}  // namespace

template <class Offset>
void Assembler::build_rows(Index begin, Index end, const FunctionElements& incident, SparsePattern& part,
                           std::vector<Offset>& offset) const {
  std::vector<Index> rank(at(d_.unknowns), -1);  // of a column in the current row
  std::vector<Index> columns;
  for (Index row = begin; row < end; ++row) {
    columns.clear();
    const auto first = incident.start[at(row)], last = incident.start[at(row) + 1];
    auto for_each_column = [&](auto visit) {
      for (auto k = first; k < last; ++k) {
        const auto [e, local] = incident.element[static_cast<std::size_t>(k)];
        for (auto c = d_.first_function[at(e)]; c < d_.first_function[at(e) + 1]; ++c)
          visit(d_.function[static_cast<std::size_t>(c)], at(e), local, c - d_.first_function[at(e)]);
      }
    };
    for_each_column([&](Index column, std::size_t, Index, std::int64_t) {
      if (rank[at(column)] == -1) columns.push_back(column);
      rank[at(column)] = 0;
    });
    std::sort(columns.begin(), columns.end());
    for (std::size_t k = 0; k < columns.size(); ++k) rank[at(columns[k])] = static_cast<Index>(k);
    for_each_column([&](Index column, std::size_t e, Index local, std::int64_t other) {
      const std::int64_t n = d_.first_function[e + 1] - d_.first_function[e];
      offset[static_cast<std::size_t>(matrix_start_[e] + local * n + other)] = static_cast<Offset>(rank[at(column)]);
    });
    for (Index column : columns) rank[at(column)] = -1;
    part.column.insert(part.column.end(), columns.begin(), columns.end());
    part.start.push_back(static_cast<std::int64_t>(part.column.size()));
  }
}

Assembler::Assembler(const Discretisation& discretisation) : d_(discretisation) {
  const FunctionElements incident = function_elements(d_);
  matrix_start_.push_back(0);
  for (std::size_t e = 0; e < d_.elements(); ++e) {
    const std::int64_t n = d_.first_function[e + 1] - d_.first_function[e];
    matrix_start_.push_back(matrix_start_.back() + n * n);
  }
  if (!rows_are_short(d_, incident)) offset_.emplace<std::vector<std::uint32_t>>();
  std::visit([&](auto& offset) { build(incident, offset); }, offset_);
}

template <class Offset>
void Assembler::build(const FunctionElements& incident, std::vector<Offset>& offset) {
  offset.resize(static_cast<std::size_t>(matrix_start_.back()));
  const auto parts_count = static_cast<std::size_t>(concurrency());
  std::vector<SparsePattern> parts(parts_count);
  const auto rows_per_part = static_cast<Index>((at(d_.unknowns) + parts_count - 1) / parts_count);
  parallel_chunks(parts_count, [&](std::size_t p) {
    const Index begin = std::min(d_.unknowns, static_cast<Index>(p) * rows_per_part);
    build_rows(begin, std::min(d_.unknowns, begin + rows_per_part), incident, parts[p], offset);
  });
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = d_.unknowns;
  for (const SparsePattern& part : parts) {
    const auto base = static_cast<std::int64_t>(pattern->column.size());
    for (std::size_t r = 1; r < part.start.size(); ++r) pattern->start.push_back(base + part.start[r]);
    pattern->column.insert(pattern->column.end(), part.column.begin(), part.column.end());
  }
  pattern_ = std::move(pattern);
}

namespace {

/// Adds the rows of one element's matrices that belong to `owner`.
template <std::size_t count, class Offset>
void add_rows(const std::array<const double*, count>& matrix, const Offset* offset, const Index* function,
              std::size_t n, const SparsePattern& p, std::size_t owner, std::size_t owners,
              std::array<SparseMatrix, count>& result) {
  constexpr std::size_t row_block = 64;  // rows are dealt to the threads in blocks, so that near rows stay together
  for (std::size_t i = 0; i < n; ++i) {
    if (at(function[i]) / row_block % owners != owner) continue;
    const auto start = p.start[at(function[i])];
    for (std::size_t k = 0; k < count; ++k) {
      double* row = result[k].value.data() + start;
      for (std::size_t j = 0; j < n; ++j) row[offset[i * n + j]] += matrix[k][i * n + j];
    }
  }
}

}  // namespace

template <std::size_t count, class ElementMatrices>
std::array<SparseMatrix, count> Assembler::assemble(const ElementMatrices& element_matrices) const {
  std::array<SparseMatrix, count> result;
  for (SparseMatrix& matrix : result) matrix = zeros(pattern_);
  // Element matrices are kept for one chunk at a time: 16 MB for regular Loop elements.
  constexpr std::size_t chunk = (1 << 14) / count;
  const auto owners = static_cast<std::size_t>(concurrency());
  std::array<std::vector<double>, count> buffer;
  for (std::size_t first = 0; first < d_.elements(); first += chunk) {
    const std::size_t last = std::min(d_.elements(), first + chunk);
    for (auto& b : buffer) b.resize(static_cast<std::size_t>(matrix_start_[last] - matrix_start_[first]));
    parallel_for(
        last - first,
        [&](std::size_t begin, std::size_t end) {
          Scratch scratch;
          std::array<double*, count> out;
          for (std::size_t e = first + begin; e < first + end; ++e) {
            for (std::size_t k = 0; k < count; ++k) {
              out[k] = buffer[k].data() + (matrix_start_[e] - matrix_start_[first]);
              std::fill_n(out[k], matrix_start_[e + 1] - matrix_start_[e], 0.0);
            }
            element_matrices(e, scratch, out);
          }
        },
        256);
    parallel_chunks(owners, [&](std::size_t owner) {
      std::visit(
          [&](const auto& offset) {
            std::array<const double*, count> matrix;
            for (std::size_t e = first; e < last; ++e) {
              for (std::size_t k = 0; k < count; ++k)
                matrix[k] = buffer[k].data() + (matrix_start_[e] - matrix_start_[first]);
              add_rows(matrix, offset.data() + matrix_start_[e], d_.function.data() + d_.first_function[e],
                       static_cast<std::size_t>(d_.first_function[e + 1] - d_.first_function[e]), *pattern_, owner,
                       owners, result);
            }
          },
          offset_);
    });
  }
  return result;
}

SparseMatrix Assembler::mass(const std::vector<Point>& control, const std::vector<double>& factor) const {
  return std::move(assemble<1>([&](std::size_t e, Scratch& scratch, const std::array<double*, 1>& out) {
    const ElementClass& c = d_.classes[at(d_.element_class[e])];
    scratch.fit(c);
    for (Index q = 0; q < c.points(); ++q) {
      const double f = factor.empty() ? 1 : factor[static_cast<std::size_t>(d_.first_point[e] + q)];
      scratch.scale[at(q)] = f * c.weight[q] * metric(c, q, d_.function.data() + d_.first_function[e], control).area;
    }
    mass_matrix(c, scratch, out[0]);
  })[0]);
}

AssembledMatrices Assembler::mass_and_stiffness(const std::vector<Point>& control) const {
  AssembledMatrices result;
  result.area.resize(d_.elements());
  auto matrices = assemble<2>([&](std::size_t e, Scratch& scratch, const std::array<double*, 2>& out) {
    const ElementClass& c = d_.classes[at(d_.element_class[e])];
    scratch.fit(c);
    double area = 0;
    for (Index q = 0; q < c.points(); ++q) {
      const Metric m = metric(c, q, d_.function.data() + d_.first_function[e], control);
      scratch.scale[at(q)] = c.weight[q] * m.area;
      scratch.form[at(q)] = gradient_form(m, c.weight[q]);
      area += scratch.scale[at(q)];
    }
    result.area[e] = area;
    mass_matrix(c, scratch, out[0]);
    stiffness_matrix(c, scratch, out[1]);
  });
  result.mass = std::move(matrices[0]);
  result.stiffness = std::move(matrices[1]);
  return result;
}

SparseMatrix Assembler::stiffness(const std::vector<Point>& control, const std::vector<double>& factor) const {
  return std::move(assemble<1>([&](std::size_t e, Scratch& scratch, const std::array<double*, 1>& out) {
    const ElementClass& c = d_.classes[at(d_.element_class[e])];
    scratch.fit(c);
    for (Index q = 0; q < c.points(); ++q) {
      const double f = factor.empty() ? 1 : factor[static_cast<std::size_t>(d_.first_point[e] + q)];
      scratch.form[at(q)] =
          gradient_form(metric(c, q, d_.function.data() + d_.first_function[e], control), f * c.weight[q]);
    }
    stiffness_matrix(c, scratch, out[0]);
  })[0]);
}

SparseMatrix Assembler::stiffness(const std::vector<Point>& control, const std::vector<Tensor>& tensor) const {
  return std::move(assemble<1>([&](std::size_t e, Scratch& scratch, const std::array<double*, 1>& out) {
    const ElementClass& c = d_.classes[at(d_.element_class[e])];
    scratch.fit(c);
    for (Index q = 0; q < c.points(); ++q)
      scratch.form[at(q)] = gradient_form(metric(c, q, d_.function.data() + d_.first_function[e], control), c.weight[q],
                                          tensor[static_cast<std::size_t>(d_.first_point[e] + q)]);
    stiffness_matrix(c, scratch, out[0]);
  })[0]);
}

}  // namespace pelage
