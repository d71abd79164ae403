#include "discretise/quadrature.h"

#include <algorithm>

#include "base/checked.h"
#include "base/parallel.h"
#include "discretise/metric.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

QuadratureGeometry quadrature_geometry(const Discretisation& d, const std::vector<Point>& control) {
  QuadratureGeometry g;
  const auto count = static_cast<std::size_t>(d.first_point.back());
  g.position.assign(count, Point{});
  g.normal.resize(count);
  g.weight.resize(count);
  parallel_for(d.elements(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const ElementClass& c = d.classes[at(d.element_class[e])];
      const Index* function = d.function.data() + d.first_function[e];
      for (Index q = 0; q < c.points(); ++q) {
        const auto point = static_cast<std::size_t>(d.first_point[e] + q);
        const Metric m = metric(c, q, function, control);
        g.weight[point] = c.weight[q] * m.area;
        const Eigen::Vector3d n(m.xv[1] * m.xw[2] - m.xv[2] * m.xw[1], m.xv[2] * m.xw[0] - m.xv[0] * m.xw[2],
                                m.xv[0] * m.xw[1] - m.xv[1] * m.xw[0]);
        const double length = n.norm();
        for (std::size_t k = 0; k < 3; ++k) g.normal[point][k] = length > 0 ? n[static_cast<int>(k)] / length : 0;
        for (Index i = 0; i < c.functions(); ++i)
          for (std::size_t k = 0; k < 3; ++k) g.position[point][k] += c.value(q, i) * control[at(function[i])][k];
      }
    }
  });
  return g;
}

std::vector<Point> quadrature_gradients(const Discretisation& d, const std::vector<Point>& control,
                                        const Vector& coefficients) {
  std::vector<Point> gradient(static_cast<std::size_t>(d.first_point.back()));
  parallel_for(d.elements(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const ElementClass& c = d.classes[at(d.element_class[e])];
      const Index* function = d.function.data() + d.first_function[e];
      for (Index q = 0; q < c.points(); ++q) {
        double v = 0, w = 0;
        for (Index i = 0; i < c.functions(); ++i) {
          v += c.dv(q, i) * coefficients[function[i]];
          w += c.dw(q, i) * coefficients[function[i]];
        }
        const Metric m = metric(c, q, function, control);
        const Form inverse = gradient_form(m, m.area > 0 ? 1 / m.area : 0);
        const Eigen::Vector3d g = (inverse.vv * v + inverse.vw * w) * m.xv + (inverse.vw * v + inverse.ww * w) * m.xw;
        gradient[static_cast<std::size_t>(d.first_point[e] + q)] = {g[0], g[1], g[2]};
      }
    }
  });
  return gradient;
}

SparseMatrix quadrature_values(const Discretisation& d) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = checked_count<std::int32_t>(d.first_point.back(), "quadrature points");
  pattern->columns = d.unknowns;
  SparseMatrix b;
  std::vector<std::pair<Index, Index>> order;  // function, local number
  for (std::size_t e = 0; e < d.elements(); ++e) {
    const ElementClass& c = d.classes[at(d.element_class[e])];
    order.clear();
    for (Index i = 0; i < c.functions(); ++i)
      order.emplace_back(d.function[static_cast<std::size_t>(d.first_function[e] + i)], i);
    std::sort(order.begin(), order.end());
    for (Index q = 0; q < c.points(); ++q) {
      for (const auto& [function, local] : order) {
        pattern->column.push_back(function);
        b.value.push_back(c.value(q, local));
      }
      pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
    }
  }
  b.pattern = std::move(pattern);
  return b;
}

}  // namespace pelage
