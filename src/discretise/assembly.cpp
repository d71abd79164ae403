#include "discretise/assembly.h"

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

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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

SparseMatrix Assembler::mass(const std::vector<Point>& control, const std::vector<double>& factor) const {
  return std::move(matrices_.sum<1, Scratch>([&](std::size_t e, Scratch& scratch, const std::array<double*, 1>& out) {
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
  auto matrices = matrices_.sum<2, Scratch>([&](std::size_t e, Scratch& scratch, const std::array<double*, 2>& out) {
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
  return std::move(matrices_.sum<1, Scratch>([&](std::size_t e, Scratch& scratch, const std::array<double*, 1>& out) {
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
  return std::move(matrices_.sum<1, Scratch>([&](std::size_t e, Scratch& scratch, const std::array<double*, 1>& out) {
    const ElementClass& c = d_.classes[at(d_.element_class[e])];
    scratch.fit(c);
    for (Index q = 0; q < c.points(); ++q)
      scratch.form[at(q)] = gradient_form(metric(c, q, d_.function.data() + d_.first_function[e], control), c.weight[q],
                                          tensor[static_cast<std::size_t>(d_.first_point[e] + q)]);
    stiffness_matrix(c, scratch, out[0]);
  })[0]);
}

}  // namespace pelage
