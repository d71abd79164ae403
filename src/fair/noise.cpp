#include "fair/noise.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/quantile.h"
#include "fair/faces.h"

namespace pelage {

namespace {

constexpr int unknowns = 6;  ///< of a quadratic height function

/// Below the quantile lie 90 % of the fits: few enough to leave out edges, enough for noise that sits on some vertices
/// only.
constexpr double share = 0.9, normal_quantile = 1.2816;  ///< the latter of the normal distribution at that share

/// The same quantile of sqrt(chi^2 / n) for n degrees of freedom (Wilson, Hilferty 1931).
double gaussian_quantile(double n) { return std::pow(1 - 2 / (9 * n) + normal_quantile * std::sqrt(2 / (9 * n)), 1.5); }

/// Root mean square of what the best quadratic in the plane across `normal` leaves of the values at the vertices
/// `near`, per degree of freedom and in units of the quantile of Gaussian noise; negative if there are too few
/// vertices.
template <class Value>
double residual(const std::vector<Point>& points, const Vector3& normal, const std::vector<Index>& near,
                const Value& value) {
  const auto count = static_cast<Eigen::Index>(near.size());
  if (count <= unknowns || !(normal.norm() > 0)) return -1;
  const Vector3 centre = vector3(points[near[0]]), x = normal.unitOrthogonal(), y = normal.cross(x);
  double scale = 0;
  for (Index w : near) scale = std::max(scale, (vector3(points[w]) - centre).norm());
  if (!(scale > 0)) return -1;
  Eigen::Matrix<double, Eigen::Dynamic, unknowns> a(count, unknowns);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector3 d = (vector3(points[near[i]]) - centre) / scale;
    const double u = d.dot(x), w = d.dot(y);
    a.row(i) << 1, u, w, u * u, u * w, w * w;
    values[i] = value(near[i]);
  }
  const Eigen::VectorXd fit = a.colPivHouseholderQr().solve(values);
  const auto freedom = static_cast<double>(count - unknowns);
  return std::sqrt((values - a * fit).squaredNorm() / freedom) / gaussian_quantile(freedom);
}

/// The quantile of the residuals at all vertices; `make_value(v, normal)` gives the function that is fitted at v.
template <class MakeValue>
double noise_of_fits(const Topology& topology, const std::vector<Point>& points, const MakeValue& make_value) {
  const FaceGeometry g = face_geometry(topology.triangles, points);
  const std::vector<Vector3> normal = vertex_means(topology, g.normal, g.area);
  std::vector<double> all(points.size());
  parallel_for(
      points.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Index> near;
        for (std::size_t v = begin; v < end; ++v) {
          topology.one_ring(static_cast<Index>(v), near);
          near.insert(near.begin(), static_cast<Index>(v));
          Vector3 wide = Vector3::Zero();  // one normal is too noisy to measure heights along
          for (Index w : near) wide += normal[w];
          wide.normalize();
          all[v] = residual(points, wide, near, make_value(v, wide));
        }
      },
      256);
  std::erase_if(all, [](double r) { return r < 0; });
  return all.empty() ? 0 : quantile(all, share);
}

}  // namespace

double estimate_noise(const Topology& topology, const std::vector<Point>& points) {
  return noise_of_fits(topology, points, [&](std::size_t v, const Vector3& normal) {
    return [&, centre = vector3(points[v])](Index w) { return (vector3(points[w]) - centre).dot(normal); };
  });
}

double estimate_noise(const Topology& topology, const std::vector<Point>& points, const std::vector<double>& values) {
  return noise_of_fits(topology, points, [&](std::size_t v, const Vector3&) {
    return [&, centre = values[v]](Index w) { return values[w] - centre; };
  });
}

}  // namespace pelage
