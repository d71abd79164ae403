#include "discretise/gradients.h"

#include "base/parallel.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Form inverse(const Metric& m) { return gradient_form(m, m.area > 0 ? 1 / m.area : 0); }

double product(const Form& g, double uv, double uw, double vv, double vw) {
  return g.vv * uv * vv + g.vw * (uv * vw + uw * vv) + g.ww * uw * vw;
}

Vector coordinate(const std::vector<Point>& points, std::size_t k) {
  Vector x(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) x[static_cast<Eigen::Index>(i)] = points[i][k];
  return x;
}

/// One coordinate at a time, by the same matrices that differentiate functions.
std::vector<Form> vertex_forms(const Discretisation& d, const std::vector<Point>& control) {
  std::array<Vector, 3> t1, t2;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector x = coordinate(control, k);
    t1[k] = d.tangent1 * x;
    t2[k] = d.tangent2 * x;
  }
  std::vector<Form> forms(at(d.unknowns));
  for (Index i = 0; i < d.unknowns; ++i)
    forms[at(i)] = inverse(metric({t1[0][i], t1[1][i], t1[2][i]}, {t2[0][i], t2[1][i], t2[2][i]}));
  return forms;
}

}  // namespace

namespace {

/// Adds area / 3 grad phi_j of an element, in whose place derivatives are those of its first quadrature point, to the
/// rows of its corners.
void add_gradients(const Discretisation& d, std::size_t e, const std::vector<Point>& control,
                   std::array<SparseMatrix, 3>& sum, Vector& area) {
  const ElementClass& c = d.classes[at(d.element_class[e])];
  const Index* function = d.function.data() + d.first_function[e];
  const Metric m = metric(c, 0, function, control);
  const Form g = inverse(m);
  for (Index i = 0; i < c.functions(); ++i) {
    area[function[i]] += m.area / 6;
    for (Index j = 0; j < c.functions(); ++j) {
      const double v = c.dv(0, j), w = c.dw(0, j);
      const Eigen::Vector3d gradient = (g.vv * v + g.vw * w) * m.xv + (g.vw * v + g.ww * w) * m.xw;
      const auto entry = static_cast<std::size_t>(sum[0].pattern->find(function[i], function[j]));
      for (std::size_t k = 0; k < 3; ++k) sum[k].value[entry] += m.area / 6 * gradient[static_cast<int>(k)];
    }
  }
}

std::array<SparseMatrix, 3> mean_gradients(const Discretisation& d, const std::vector<Point>& control,
                                           const std::shared_ptr<const SparsePattern>& pattern) {
  std::array<SparseMatrix, 3> mean = {zeros(pattern), zeros(pattern), zeros(pattern)};
  Vector area = Vector::Zero(d.unknowns);
  for (std::size_t e = 0; e < d.elements(); ++e) add_gradients(d, e, control, mean, area);
  for (SparseMatrix& m : mean)
    for (Index i = 0; i < d.unknowns; ++i)
      for (auto k = pattern->start[at(i)]; k < pattern->start[at(i) + 1]; ++k)
        if (area[i] > 0) m.value[static_cast<std::size_t>(k)] /= area[i];
  return mean;
}

}  // namespace

Gradients::Gradients(const Discretisation& d, const std::vector<Point>& control,
                     const std::shared_ptr<const SparsePattern>& pattern)
    : d_(d), at_points_(static_cast<std::size_t>(d.first_point.back())) {
  parallel_for(d.elements(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const ElementClass& c = d.classes[at(d.element_class[e])];
      const Index* function = d.function.data() + d.first_function[e];
      for (Index q = 0; q < c.points(); ++q)
        at_points_[static_cast<std::size_t>(d.first_point[e] + q)] = inverse(metric(c, q, function, control));
    }
  });
  if (d.nodal)
    mean_ = mean_gradients(d, control, pattern);
  else
    at_vertices_ = vertex_forms(d, control);
}

Vector Gradients::at_quadrature_points(const Vector& u, const Vector& v) const {
  Vector result(static_cast<Eigen::Index>(at_points_.size()));
  parallel_for(d_.elements(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const ElementClass& c = d_.classes[at(d_.element_class[e])];
      const Index* function = d_.function.data() + d_.first_function[e];
      for (Index q = 0; q < c.points(); ++q) {
        double uv = 0, uw = 0, vv = 0, vw = 0;
        for (Index i = 0; i < c.functions(); ++i) {
          uv += c.dv(q, i) * u[function[i]];
          uw += c.dw(q, i) * u[function[i]];
          vv += c.dv(q, i) * v[function[i]];
          vw += c.dw(q, i) * v[function[i]];
        }
        const auto point = static_cast<std::size_t>(d_.first_point[e] + q);
        result[static_cast<Eigen::Index>(point)] = product(at_points_[point], uv, uw, vv, vw);
      }
    }
  });
  return result;
}

Vector Gradients::at_vertices(const Vector& u, const Vector& v) const {
  if (d_.nodal) {
    Vector result = Vector::Zero(d_.unknowns);
    for (const SparseMatrix& mean : mean_) result += (mean * u).cwiseProduct(mean * v);
    return result;
  }
  Vector u1, u2, v1, v2;
  apply(d_.tangent1, u, u1);
  apply(d_.tangent2, u, u2);
  apply(d_.tangent1, v, v1);
  apply(d_.tangent2, v, v2);
  for (Eigen::Index i = 0; i < u1.size(); ++i)
    u1[i] = product(at_vertices_[at(static_cast<Index>(i))], u1[i], u2[i], v1[i], v2[i]);
  return u1;
}

}  // namespace pelage
