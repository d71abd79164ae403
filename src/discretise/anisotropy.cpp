#include "discretise/anisotropy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Point times(const Tensor& t, const Point& a) {
  return {t[0] * a[0] + t[1] * a[1] + t[2] * a[2], t[1] * a[0] + t[3] * a[1] + t[4] * a[2],
          t[2] * a[0] + t[4] * a[1] + t[5] * a[2]};
}

/// Any unit vector across n.
Point some_tangent(const Point& n) {
  const Point axis = std::abs(n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  return unit(cross(n, axis));
}

Point turned(const Point& e, const Point& f, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * e[0] + s * f[0], c * e[1] + s * f[1], c * e[2] + s * f[2]};
}

/// The tangent line nearest to a mean of lines: the first eigenvector of its tangential part.
Point mean_line(const Tensor& t, const Point& n) {
  const Point e = some_tangent(n), f = cross(n, e);
  const double ee = dot(e, times(t, e)), ef = dot(e, times(t, f)), ff = dot(f, times(t, f));
  return turned(e, f, std::atan2(2 * ef, ee - ff) / 2);
}

}  // namespace

Eigen::Matrix3d matrix_of(const Tensor& t) {
  return (Eigen::Matrix3d() << t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5]).finished();
}

Tensor line_tensor(const Point& d) {
  return {d[0] * d[0], d[0] * d[1], d[0] * d[2], d[1] * d[1], d[1] * d[2], d[2] * d[2]};
}

Tensor plane_tensor(const Point& d) {
  const Tensor line = line_tensor(d);
  return {1 - line[0], -line[1], -line[2], 1 - line[3], -line[4], 1 - line[5]};
}

Tensor surface_tensor(const Tensor& mean, const Point& normal, double theta, double a1, double a2) {
  const Point line = mean_line(mean, normal), d = turned(line, cross(normal, line), theta);
  Tensor t = line_tensor(d);
  const Tensor other = line_tensor(cross(normal, d));
  for (std::size_t k = 0; k < 6; ++k) t[k] = a1 * a1 * t[k] + a2 * a2 * other[k];
  return t;
}

Tensor volume_tensor(const Tensor& mean, double a1, double a2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(matrix_of(mean));
  const bool plane = mean[0] + mean[3] + mean[5] > 1.5;
  const Eigen::Vector3d d = axes.eigenvectors().col(plane ? 0 : 2);
  if (plane) std::swap(a1, a2);
  const Eigen::Matrix3d t = a2 * a2 * Eigen::Matrix3d::Identity() + (a1 * a1 - a2 * a2) * d * d.transpose();
  return {t(0, 0), t(0, 1), t(0, 2), t(1, 1), t(1, 2), t(2, 2)};
}

void require_unturned(const Kinetics::TensorField& rates) {
  if (std::ranges::any_of(rates.theta, [](double theta) { return theta != 0; }))
    throw Error(Fault::usage, "directions in a volume cannot be turned by an angle; let theta be 0 and give the lines");
}

std::vector<Tensor> quadrature_tensors(const Discretisation& d, const std::vector<Point>& control,
                                       const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) {
  const std::vector<Point> normal = quadrature_geometry(d, control).normal;
  std::vector<Tensor> result(normal.size());
  parallel_for(d.elements(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const ElementClass& c = d.classes[at(d.element_class[e])];
      for (std::size_t k = 0; k < c.place.size(); ++k) {
        const auto [v, w] = c.place[k];
        const std::size_t q = static_cast<std::size_t>(d.first_point[e]) + k;
        Tensor mean{};
        for (std::size_t corner = 0; corner < 3; ++corner)
          for (std::size_t i = 0; i < 6; ++i)
            mean[i] += std::array{1 - v - w, v, w}[corner] * lines[at(d.topology->triangles[e][corner])][i];
        result[q] = surface_tensor(mean, normal[q], rates.theta[q], rates.a1[q], rates.a2[q]);
      }
    }
  });
  return result;
}

namespace {

double ratio(double smallest, double largest) { return largest > 0 ? std::sqrt(largest / std::max(smallest, 0.0)) : 1; }

double ratio_across(const Tensor& t, const Point& n) {
  if (dot(n, n) == 0) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(matrix_of(t), Eigen::EigenvaluesOnly);
    return ratio(axes.eigenvalues()[0], axes.eigenvalues()[2]);
  }
  const Point e = some_tangent(n), f = cross(n, e);
  const double ee = dot(e, times(t, e)), ef = dot(e, times(t, f)), ff = dot(f, times(t, f));
  const double mean = (ee + ff) / 2, radius = std::hypot((ee - ff) / 2, ef);
  return ratio(mean - radius, mean + radius);
}

}  // namespace

double largest_ratio(const std::vector<Tensor>& tensors, const std::vector<Point>& normals) {
  double largest = 1;
  for (std::size_t q = 0; q < tensors.size(); ++q) largest = std::max(largest, ratio_across(tensors[q], normals[q]));
  return largest;
}

double largest_ratio(const Kinetics::TensorField& rates) {
  double ratio = 1;
  for (std::size_t i = 0; i < rates.a1.size(); ++i) {
    const double a = std::abs(rates.a1[i]), b = std::abs(rates.a2[i]);
    if (std::max(a, b) > 0) ratio = std::max(ratio, std::max(a, b) / std::min(a, b));
  }
  return ratio;
}

}  // namespace pelage
