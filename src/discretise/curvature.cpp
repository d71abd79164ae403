#include "discretise/curvature.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "discretise/metric.h"
#include "shape/normals.h"

namespace pelage {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Vector3d combined(const RowMatrix& table, Index q, const Index* function, const std::vector<Point>& points) {
  Vector3d sum = Vector3d::Zero();
  for (Index i = 0; i < static_cast<Index>(table.cols()); ++i)
    sum += table(q, i) * Eigen::Map<const Vector3d>(points[at(function[i])].data());
  return sum;
}

/// The second fundamental form -x_ij . n from the second derivatives of the surface.
Form second_form(const ElementClass& c, Index q, const Index* function, const std::vector<Point>& control,
                 const Vector3d& normal) {
  return {-combined(c.dvv, q, function, control).dot(normal), -combined(c.dvw, q, function, control).dot(normal),
          -combined(c.dww, q, function, control).dot(normal)};
}

/// The same as x_i . n_j from normals at the vertices, made symmetric (Rusinkiewicz 2004 estimates it so).
Form second_form(const ElementClass& c, Index q, const Index* function, const std::vector<Point>& normals,
                 const Metric& m) {
  const Vector3d nv = combined(c.dv, q, function, normals), nw = combined(c.dw, q, function, normals);
  return {m.xv.dot(nv), (m.xv.dot(nw) + m.xw.dot(nv)) / 2, m.xw.dot(nw)};
}

/// [x_v x_w] G^-1 II G^-1 [x_v x_w]'.
Tensor in_space(const Metric& m, const Form& ii) {
  const Form inverse = gradient_form(m, m.area > 0 ? 1 / m.area : 0);  // G^-1
  const Vector3d v = inverse.vv * m.xv + inverse.vw * m.xw;
  const Vector3d w = inverse.vw * m.xv + inverse.ww * m.xw;
  const Matrix3d s =
      ii.vv * v * v.transpose() + ii.vw * (v * w.transpose() + w * v.transpose()) + ii.ww * w * w.transpose();
  return {s(0, 0), s(0, 1), s(0, 2), s(1, 1), s(1, 2), s(2, 2)};
}

}  // namespace

std::vector<Tensor> quadrature_curvature(const Discretisation& d, const std::vector<Point>& control) {
  const bool flat = d.classes.empty() || d.classes[0].dvv.size() == 0;
  const std::vector<Point> normals = flat ? vertex_normals(d.topology->triangles, control) : std::vector<Point>{};
  std::vector<Tensor> curvature(at(d.first_point.back()), Tensor{});
  parallel_for(d.elements(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const ElementClass& c = d.classes[at(d.element_class[e])];
      const Index* function = d.function.data() + d.first_function[e];
      for (Index q = 0; q < c.points(); ++q) {
        const Metric m = metric(c, q, function, control);
        const Form ii = flat ? second_form(c, q, function, normals, m)
                             : second_form(c, q, function, control, m.xv.cross(m.xw).normalized());
        curvature[at(d.first_point[e] + q)] = in_space(m, ii);
      }
    }
  });
  return curvature;
}

std::vector<Tensor> vertex_curvature(const Discretisation& d, const std::vector<Point>& control) {
  const std::vector<Tensor> inside = quadrature_curvature(d, control);
  const std::vector<double> weight = quadrature_geometry(d, control).weight;
  std::vector<Tensor> mean(at(d.unknowns), Tensor{});
  std::vector<double> area(at(d.unknowns), 0.0);
  for (std::size_t e = 0; e < d.elements(); ++e)
    for (auto q = at(d.first_point[e]); q < at(d.first_point[e + 1]); ++q)
      for (Index v : d.topology->triangles[e]) {
        for (std::size_t k = 0; k < 6; ++k) mean[at(v)][k] += weight[q] * inside[q][k];
        area[at(v)] += weight[q];
      }
  for (std::size_t v = 0; v < mean.size(); ++v)
    for (double& x : mean[v]) x = area[v] > 0 ? x / area[v] : 0;
  return mean;
}

PrincipalCurvatures principal_curvatures(const std::vector<Tensor>& curvature, const std::vector<Point>& normal) {
  PrincipalCurvatures result{std::vector<double>(curvature.size()), std::vector<double>(curvature.size())};
  parallel_for(curvature.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3d n(normal[i][0], normal[i][1], normal[i][2]);
      const Matrix3d along = Matrix3d::Identity() - n * n.transpose();
      const Matrix3d s = along * matrix_of(curvature[i]) * along;
      // Eigenvalues 0, k1, k2: trace = k1 + k2, squared norm = k1^2 + k2^2.
      const double mean = s.trace() / 2;
      const double half = std::sqrt(std::max(0.0, s.squaredNorm() / 2 - mean * mean));
      result.k1[i] = mean + half;
      result.k2[i] = mean - half;
    }
  });
  return result;
}

}  // namespace pelage
