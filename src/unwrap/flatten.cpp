#include "unwrap/flatten.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "shape/edges.h"
#include "shape/vectors.h"
#include "unwrap/block_solver.h"
#include "unwrap/stretch.h"

namespace pelage {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Values of the vertices: 2 v and 2 v + 1 are the coordinates of vertex v.
Vector2d at(const VectorXd& x, std::int32_t v) { return x.segment<2>(2 * Eigen::Index{v}); }

std::vector<RestTriangle> rest_triangles(const LinkedFaces& faces, const Chart& chart) {
  std::vector<RestTriangle> rest;
  rest.reserve(chart.source.size());
  for (const std::int32_t t : chart.source) {
    const Triangle& v = faces.triangles[t];
    rest.push_back(rest_triangle({faces.points[v[0]], faces.points[v[1]], faces.points[v[2]]}));
  }
  return rest;
}

/// Symmetric Dirichlet energy of a map of one triangle in its singular value decomposition J = U diag(s) V'.
struct Distortion {
  Matrix2d u, v;
  double s1, s2;

  explicit Distortion(const Matrix2d& j) {
    const double e = (j(0, 0) + j(1, 1)) / 2, f = (j(0, 0) - j(1, 1)) / 2;
    const double g = (j(1, 0) + j(0, 1)) / 2, h = (j(1, 0) - j(0, 1)) / 2;
    const double q = std::hypot(e, h), r = std::hypot(f, g);
    s1 = q + r;
    s2 = q - r;
    const double a1 = std::atan2(g, f), a2 = std::atan2(h, e);
    u = Eigen::Rotation2D<double>((a2 + a1) / 2).toRotationMatrix();
    v = Eigen::Rotation2D<double>((a1 - a2) / 2).toRotationMatrix();
  }

  static double slope(double s) { return 2 * s - 2 / (s * s * s); }
  Matrix2d gradient() const { return u * Vector2d(slope(s1), slope(s2)).asDiagonal() * v.transpose(); }
  /// Eigenvalues of the Hessian, the negative one as 0: along s1, along s2, of rotations, of shears.
  std::array<double, 4> eigenvalues() const {
    const double det = s1 * s2;
    return {2 + 6 / (s1 * s1 * s1 * s1), 2 + 6 / (s2 * s2 * s2 * s2),
            std::max(0.0, (slope(s1) + slope(s2)) / (s1 + s2)), 2 + 2 * (s1 * s1 + det + s2 * s2) / (det * det * det)};
  }
  std::array<Matrix2d, 4> directions() const {
    const double r = std::numbers::sqrt2 / 2;
    std::array<Matrix2d, 4> m;
    m[0] << 1, 0, 0, 0;
    m[1] << 0, 0, 0, 1;
    m[2] << 0, -r, r, 0;
    m[3] << 0, r, r, 0;
    for (Matrix2d& d : m) d = u * d * v.transpose();
    return m;
  }
};

/// d J_ab / d u_i[a] = row i of this, in the order of the triangle's corners.
Eigen::Matrix<double, 3, 2> corner_gradients(const RestTriangle& rest) {
  Eigen::Matrix<double, 3, 2> g;
  g.row((rest.first + 1) % 3) = rest.inverse.row(0);
  g.row((rest.first + 2) % 3) = rest.inverse.row(1);
  g.row(rest.first) = -rest.inverse.row(0) - rest.inverse.row(1);
  return g;
}

using Six = Eigen::Matrix<double, 6, 1>;

/// The derivative of the product of J with a matrix by the corners' places.
Six by_corners(const Eigen::Matrix<double, 3, 2>& g, const Matrix2d& m) {
  Six result;
  for (int i = 0; i < 3; ++i) result.segment<2>(2 * i) = m * g.row(i).transpose();
  return result;
}

class Flattener {
 public:
  Flattener(const LinkedFaces& faces, const Chart& chart)
      : chart_(chart), rest_(rest_triangles(faces, chart)), border_(border_of(chart)) {
    for (const RestTriangle& r : rest_) area_ += r.area;
    for (const HalfEdge h : border_) {
      const std::int32_t a = chart.place[tail(chart.triangles, h)], b = chart.place[tip(chart.triangles, h)];
      border_length_.push_back(length(difference(faces.points[a], faces.points[b])));
    }
  }

  /// Nothing where triangles are turned over.
  std::optional<VectorXd> conformal();
  VectorXd tutte();
  void minimise(VectorXd& x);
  StretchSum stretch(const VectorXd& x) const;

 private:
  BlockSolver& solver() {
    if (!solver_) solver_.emplace(chart_.place.size(), chart_.triangles);
    return *solver_;
  }
  Matrix2d derivative(std::size_t t, const VectorXd& x) const {
    const Triangle& v = chart_.triangles[t];
    return rest_[t].derivative({at(x, v[0]), at(x, v[1]), at(x, v[2])});
  }
  bool keeps_sides(const VectorXd& x) const {
    for (std::size_t t = 0; t < rest_.size(); ++t)
      if (!(derivative(t, x).determinant() > 0)) return false;
    return true;
  }
  /// Of the whole, at the area of the surface.
  void scale(VectorXd& x) const {
    double flat = 0;
    for (std::size_t t = 0; t < rest_.size(); ++t) flat += rest_[t].area * derivative(t, x).determinant();
    x *= std::sqrt(area_ / flat);
  }
  double energy(const VectorXd& x) const;
  VectorXd newton_step(const VectorXd& x, double& slope);
  double longest_step(const VectorXd& x, const VectorXd& step) const;
  std::pair<std::int32_t, std::int32_t> pins() const;

  const Chart& chart_;
  std::vector<RestTriangle> rest_;
  std::vector<std::int32_t> border_;
  std::vector<double> border_length_;
  std::optional<BlockSolver> solver_;
  double area_ = 0;
};

/// Two vertices of the border, half of its length apart.
std::pair<std::int32_t, std::int32_t> Flattener::pins() const {
  double half = 0;
  for (const double l : border_length_) half += l / 2;
  std::size_t k = 0;
  while (k + 2 < border_.size() && half > 0) half -= border_length_[k++];
  return {tail(chart_.triangles, border_[0]), tail(chart_.triangles, border_[std::max<std::size_t>(k, 1)])};
}

/// Dirichlet's energy less the area that is covered; two vertices are held by springs that are stiff beside the
/// triangles.
std::optional<VectorXd> Flattener::conformal() {
  solver().clear();
  for (std::size_t t = 0; t < rest_.size(); ++t) {
    const Eigen::Matrix<double, 3, 2> g = corner_gradients(rest_[t]);
    TriangleBlock block;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double along = rest_[t].area * g.row(i).dot(g.row(j));
        const double across = rest_[t].area * (g(i, 0) * g(j, 1) - g(i, 1) * g(j, 0));
        block.block<2, 2>(2 * i, 2 * j) << along, -across, across, along;
      }
    solver().add(t, block);
  }
  constexpr double stiff = 1e6;
  const auto [a, b] = pins();
  for (std::int32_t v = 0; v < std::ssize(chart_.place); ++v)
    solver().add_diagonal(v, v == a || v == b ? stiff : 1e-12);
  if (!solver().factorise()) return {};
  VectorXd pull = VectorXd::Zero(2 * std::ssize(chart_.place));
  pull[2 * b] = stiff;
  VectorXd x = solver().solve(pull);
  if (!keeps_sides(x)) return {};
  scale(x);
  return x;
}

/// Every inner vertex in the middle of its neighbours; the border on a circle, by its length.
VectorXd Flattener::tutte() {
  solver().clear();
  TriangleBlock block;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) block(i, j) = i == j ? 2 : (i % 2 == j % 2 ? -1 : 0);
  for (std::size_t t = 0; t < rest_.size(); ++t) solver().add(t, block);
  constexpr double stiff = 1e8;
  double whole = 0, along = 0;
  for (const double l : border_length_) whole += l;
  VectorXd pull = VectorXd::Zero(2 * std::ssize(chart_.place));
  for (std::size_t k = 0; k < border_.size(); ++k) {
    // Half by length and half by number, so that no two vertices are too near to tell apart.
    const double part = (along / whole + static_cast<double>(k) / static_cast<double>(border_.size())) / 2;
    const double angle = 2 * std::numbers::pi * part;
    const std::int32_t v = tail(chart_.triangles, border_[k]);
    solver().add_diagonal(v, stiff);
    pull.segment<2>(2 * Eigen::Index{v}) = stiff * Vector2d(std::cos(angle), std::sin(angle));
    along += border_length_[k];
  }
  if (!solver().factorise()) return {};
  VectorXd x = solver().solve(pull);
  scale(x);
  return x;
}

double Flattener::energy(const VectorXd& x) const {
  double sum = 0;
  for (std::size_t t = 0; t < rest_.size(); ++t) {
    const Matrix2d j = derivative(t, x);
    const double det = j.determinant();
    if (!(det > 0)) return std::numeric_limits<double>::infinity();
    sum += rest_[t].area * j.squaredNorm() * (1 + 1 / (det * det));
  }
  return sum;
}

VectorXd Flattener::newton_step(const VectorXd& x, double& slope) {
  VectorXd gradient = VectorXd::Zero(x.size());
  solver().clear();
  for (std::size_t t = 0; t < rest_.size(); ++t) {
    const Eigen::Matrix<double, 3, 2> g = corner_gradients(rest_[t]);
    const Distortion distortion(derivative(t, x));
    const Six down = rest_[t].area * by_corners(g, distortion.gradient());
    for (int i = 0; i < 3; ++i) gradient.segment<2>(2 * Eigen::Index{chart_.triangles[t][i]}) += down.segment<2>(2 * i);
    const std::array<double, 4> value = distortion.eigenvalues();
    const std::array<Matrix2d, 4> direction = distortion.directions();
    TriangleBlock block = TriangleBlock::Zero();
    for (int k = 0; k < 4; ++k) {
      const Six b = by_corners(g, direction[k]);
      block.noalias() += rest_[t].area * value[k] * b * b.transpose();
    }
    solver().add(t, block);
  }
  // The chart may shift and turn as it likes.
  for (std::size_t v = 0; v < chart_.place.size(); ++v) solver().add_diagonal(v, 1e-8);
  slope = 0;
  if (!solver().factorise()) return VectorXd::Zero(x.size());
  const VectorXd step = solver().solve(-gradient);
  slope = gradient.dot(step);
  return step;
}

/// The step at which the first triangle has no area left (Smith, Schaefer 2015).
double Flattener::longest_step(const VectorXd& x, const VectorXd& step) const {
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < rest_.size(); ++t) {
    const Matrix2d j = derivative(t, x), d = derivative(t, step);
    const double a = d.determinant(), c = j.determinant();
    const double b = j(0, 0) * d(1, 1) + d(0, 0) * j(1, 1) - j(0, 1) * d(1, 0) - d(0, 1) * j(1, 0);
    const double inside = b * b - 4 * a * c;
    if (inside < 0) continue;
    // The smallest positive root of a s^2 + b s + c, c > 0, if there is one.
    const double q = std::sqrt(inside) - b;
    if (q > 0) longest = std::min(longest, 2 * c / q);
  }
  return longest;
}

/// Steps that are enough near an isometry, and the decrease, beside the energy, below which it is reached.
constexpr int most_steps = 12;
constexpr double least_decrease = 1e-6;

void Flattener::minimise(VectorXd& x) {
  double now = energy(x);
  for (int k = 0; k < most_steps; ++k) {
    double slope = 0;
    const VectorXd step = newton_step(x, slope);
    if (!(slope < -least_decrease * now)) return;
    double length = std::min(1.0, 0.8 * longest_step(x, step)), next = energy(x + length * step);
    while (!(next <= now + 1e-4 * length * slope) && length > 1e-9) {
      length /= 2;
      next = energy(x + length * step);
    }
    if (!(next < now)) return;
    x += length * step;
    now = next;
  }
}

StretchSum Flattener::stretch(const VectorXd& x) const {
  StretchSum sum;
  for (std::size_t t = 0; t < rest_.size(); ++t) sum.add(rest_[t].area, derivative(t, x));
  return sum;
}

void keep(const VectorXd& x, const Flattener& flattener, Chart& chart) {
  const StretchSum sum = flattener.stretch(x);
  chart.stretch = sum.stretch();
  const double scale = std::sqrt(sum.area / sum.flat);
  chart.uv.resize(chart.place.size());
  for (std::size_t v = 0; v < chart.uv.size(); ++v) chart.uv[v] = {scale * x[2 * v], scale * x[2 * v + 1]};
}

}  // namespace

bool flatten(const LinkedFaces& faces, Chart& chart, const std::function<bool(const Chart&)>& promising) {
  Flattener flattener(faces, chart);
  std::optional<VectorXd> x = flattener.conformal();
  if (!x || !x->allFinite()) return false;
  keep(*x, flattener, chart);
  if (promising && !promising(chart)) return false;
  flattener.minimise(*x);
  keep(*x, flattener, chart);
  return std::isfinite(chart.stretch);
}

void embed(const LinkedFaces& faces, Chart& chart) {
  Flattener flattener(faces, chart);
  keep(flattener.tutte(), flattener, chart);
}

}  // namespace pelage
