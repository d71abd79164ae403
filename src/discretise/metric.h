#pragma once
// The first fundamental form of the surface at a quadrature point.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "discretise/discretisation.h"
#include "pelage/point.h"

namespace pelage {

/// Tangents x_v, x_w and the metric G at one quadrature point.
struct Metric {
  Eigen::Vector3d xv = Eigen::Vector3d::Zero(), xw = Eigen::Vector3d::Zero();
  double g11 = 0, g12 = 0, g22 = 0;
  double area = 0;  ///< area element, |x_v x x_w|
};

inline Metric metric(const Eigen::Vector3d& xv, const Eigen::Vector3d& xw) {
  Metric m;
  m.xv = xv;
  m.xw = xw;
  m.g11 = m.xv.dot(m.xv);
  m.g12 = m.xv.dot(m.xw);
  m.g22 = m.xw.dot(m.xw);
  m.area = std::sqrt(std::max(0.0, m.g11 * m.g22 - m.g12 * m.g12));
  return m;
}

inline Metric metric(const ElementClass& c, Index q, const Index* function, const std::vector<Point>& control) {
  Eigen::Vector3d xv = Eigen::Vector3d::Zero(), xw = Eigen::Vector3d::Zero();
  for (Index i = 0; i < c.functions(); ++i) {
    const Point& p = control[static_cast<std::size_t>(function[i])];
    const double v = c.dv(q, i), w = c.dw(q, i);
    for (int k = 0; k < 3; ++k) {
      xv[k] += v * p[static_cast<std::size_t>(k)];
      xw[k] += w * p[static_cast<std::size_t>(k)];
    }
  }
  return metric(xv, xw);
}

/// A symmetric 2x2 matrix in the parameters (v, w).
struct Form {
  double vv, vw, ww;
};

/// weight * area * G^-1: the gradient's scalar product. A point where the surface degenerates contributes nothing.
inline Form gradient_form(const Metric& m, double weight) {
  if (!(m.area > 0)) return {0, 0, 0};
  const double scale = weight / m.area;  // weight * area / det G
  return {scale * m.g22, -scale * m.g12, scale * m.g11};
}

}  // namespace pelage
