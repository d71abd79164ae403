#include "measure/pattern.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "base/quantile.h"
#include "base/unions.h"
#include "discretise/method.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/topology.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A triangle with the values at its corners.
struct Piece {
  Eigen::Matrix3d corner;  ///< columns
  Eigen::Vector3d value;
  Eigen::Vector3d doubled_area() const { return (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)); }
  double area() const { return doubled_area().norm() / 2; }
  /// 0 without area.
  Eigen::Vector3d gradient() const {
    const Eigen::Vector3d n = doubled_area();
    if (!(n.squaredNorm() > 0)) return Eigen::Vector3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) sum += value[k] * (corner.col((k + 2) % 3) - corner.col((k + 1) % 3));
    return n.cross(sum) / n.squaredNorm();
  }
};

Piece piece_of(const TriangleMesh& mesh, const std::vector<double>& values, const Triangle& t) {
  Piece piece;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const std::size_t v = at(t[static_cast<std::size_t>(k)]);
    piece.corner.col(k) = Eigen::Vector3d::Map(mesh.points[v].data());
    piece.value[k] = values[v];
  }
  return piece;
}

/// The part of a triangle above a level, and the length of the line between the parts.
struct Split {
  double above = 0, line = 0;
};

Split split(const Piece& piece, double level) {
  const Eigen::Vector3d h = piece.value.array() - level;
  const auto high = (h.array() > 0).count();
  if (high == 0) return {};
  const double area = piece.area();
  if (high == 3) return {area, 0};
  // The corner that is alone on its side, and where the line crosses its two edges.
  Eigen::Index alone = 0;
  while ((h[alone] > 0) != (high == 1)) ++alone;
  const auto crossing = [&](Eigen::Index other) { return h[alone] / (h[alone] - h[other]); };
  const Eigen::Index b = (alone + 1) % 3, c = (alone + 2) % 3;
  const double to_b = crossing(b), to_c = crossing(c), corner = area * to_b * to_c;
  const Eigen::Vector3d line =
      to_b * (piece.corner.col(b) - piece.corner.col(alone)) - to_c * (piece.corner.col(c) - piece.corner.col(alone));
  return {high == 1 ? corner : area - corner, line.norm()};
}

/// Connected parts of a linear function above and below a level are those of its vertices there.
std::size_t count_parts(const std::vector<Triangle>& triangles, const std::vector<double>& values, double level,
                        bool above) {
  const auto inside = [&](Index v) { return (values[at(v)] > level) == above; };
  Unions parts(values.size());
  std::vector<char> used(values.size(), 0);
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!inside(t[k])) continue;
      used[at(t[k])] = 1;
      if (const Index next = t[(k + 1) % 3]; inside(next)) parts.unite(t[k], next);
    }
  std::size_t count = 0;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v] && parts.root(static_cast<Index>(v)) == static_cast<Index>(v)) ++count;
  return count;
}

double middle_level(std::vector<double> values) {
  constexpr double share = 0.005;
  const double low = quantile(values, share), high = quantile(values, 1 - share);
  return (low + high) / 2;
}

void add_statistics(const TriangleMesh& mesh, const std::vector<double>& values, PatternMeasures& m) {
  double integral = 0, square = 0;
  for (const Triangle& t : mesh.triangles) {
    const Piece piece = piece_of(mesh, values, t);
    const double area = piece.area(), sum = piece.value.sum();
    m.area += area;
    integral += area * sum / 3;
    square += area * (piece.value.squaredNorm() + sum * sum) / 12;
    const Split s = split(piece, m.level);
    m.above.share += s.above;
    m.border += s.line;
  }
  if (!(m.area > 0)) throw Error(Fault::input, "the surface has no area");
  m.above.share /= m.area;
  m.below.share = 1 - m.above.share;
  m.mean = integral / m.area;
  m.deviation = std::sqrt(std::max(0.0, square / m.area - m.mean * m.mean));
}

void add_phases(const TriangleMesh& mesh, const std::vector<double>& values, PatternMeasures& m) {
  m.above.parts = count_parts(mesh.triangles, values, m.level, true);
  m.below.parts = count_parts(mesh.triangles, values, m.level, false);
  for (PatternPhase* phase : {&m.above, &m.below})
    if (m.border > 0) phase->width = 2 * phase->share * m.area / m.border;
  const double most = static_cast<double>(std::max(m.above.parts, m.below.parts));
  if (most > 0) m.spacing = std::sqrt(2 * m.area / (std::numbers::sqrt3 * most));
}

double mean_square_slope(const TriangleMesh& mesh, const std::vector<double>& values, double area) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Piece piece = piece_of(mesh, values, t);
    sum += piece.area() * piece.gradient().squaredNorm();
  }
  return sum / area;
}

/// g g' of the slopes g around every vertex: the means over Gaussians, by a step of diffusion.
std::vector<Eigen::Matrix3d> slope_tensors(const TriangleMesh& mesh, const std::vector<double>& values, double sigma) {
  const auto vertices = static_cast<Index>(values.size());
  const auto topology = std::make_shared<const Topology>(make_topology(values.size(), mesh.triangles));
  const auto space = linear_method.make_space(topology, mesh.points);
  std::vector<Vector> load(6, Vector::Zero(vertices));
  for (const Triangle& t : mesh.triangles) {
    const Piece piece = piece_of(mesh, values, t);
    const Eigen::Matrix3d tensor = piece.gradient() * piece.gradient().transpose() * (piece.area() / 3);
    for (const Index v : t)
      for (Eigen::Index i = 0, k = 0; i < 3; ++i)
        for (Eigen::Index j = i; j < 3; ++j, ++k) load[static_cast<std::size_t>(k)][v] += tensor(i, j);
  }
  const SparseMatrix mass = *space->sampled(SampleRule::quadrature).mass;
  SparseMatrix step = mass;
  combine(1, mass, sigma * sigma / 2, *space->stiffness(), step);
  std::vector<Eigen::Matrix3d> tensors(values.size());
  for (Eigen::Index i = 0, k = 0; i < 3; ++i)
    for (Eigen::Index j = i; j < 3; ++j, ++k) {
      const Vector x = solve_spd(step, load[static_cast<std::size_t>(k)]);
      for (std::size_t v = 0; v < tensors.size(); ++v)
        tensors[v](i, j) = tensors[v](j, i) = x[static_cast<Eigen::Index>(v)];
    }
  return tensors;
}

/// Means over the vertices, weighted with their slopes; every vertex stands for a part of the area that its triangles
/// share.
void add_directions(const TriangleMesh& mesh, const std::vector<double>& values, PatternMeasures& m) {
  const std::vector<Eigen::Matrix3d> tensors = slope_tensors(mesh, values, m.wavelength / 2);
  std::vector<double> share(values.size(), 0);
  std::vector<Eigen::Vector3d> normal(values.size(), Eigen::Vector3d::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Piece piece = piece_of(mesh, values, t);
    for (const Index v : t) {
      share[at(v)] += piece.area() / 3;
      normal[at(v)] += piece.doubled_area();
    }
  }
  double slopes = 0, coherent = 0;
  Eigen::Array3d along = Eigen::Array3d::Zero();
  for (std::size_t v = 0; v < tensors.size(); ++v) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(tensors[v]);
    const double across = eigen.eigenvalues()[2], other = std::max(0.0, eigen.eigenvalues()[1]);
    if (!(across > 0)) continue;
    const double weight = share[v] * (across + other), aligned = share[v] * (across - other);
    slopes += weight;
    coherent += aligned;
    along += aligned * normal[v].cross(eigen.eigenvectors().col(2)).normalized().array().square();
  }
  if (!(slopes > 0)) return;
  m.coherence = coherent / slopes;
  if (coherent > 0)
    for (std::size_t d = 0; d < 3; ++d) m.along[d] = along[static_cast<Eigen::Index>(d)] / coherent;
}

}  // namespace

PatternMeasures measure_pattern(const TriangleMesh& mesh, const std::vector<double>& values,
                                const std::optional<double>& level) {
  if (values.empty()) throw Error(Fault::input, "the surface has no vertices");
  PatternMeasures m;
  m.level = level ? *level : middle_level(values);
  m.minimum = std::ranges::min(values);
  m.maximum = std::ranges::max(values);
  add_statistics(mesh, values, m);
  add_phases(mesh, values, m);
  const double slope = mean_square_slope(mesh, values, m.area);
  if (!(slope > 0) || !(m.deviation > 0)) return m;
  m.wavelength = 2 * std::numbers::pi * m.deviation / std::sqrt(slope);
  add_directions(mesh, values, m);
  return m;
}

}  // namespace pelage
