#include "measure/pattern.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "base/quantile.h"
#include "measure/defects.h"
#include "measure/parts.h"
#include "measure/slopes.h"
#include "measure/spectrum.h"
#include "measure/spots.h"
#include "pelage/error.h"
#include "shape/topology.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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
  m.above.parts = connected_parts(mesh.triangles, values, m.level, true).count;
  m.below.parts = connected_parts(mesh.triangles, values, m.level, false).count;
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

/// Means over the vertices, weighted with their slopes; every vertex stands for a part of the area that its triangles
/// share.
void add_directions(const TriangleMesh& mesh, const std::vector<double>& values,
                    const std::vector<Eigen::Matrix3d>& tensors, const std::vector<Eigen::Vector3d>& normal,
                    PatternMeasures& m) {
  std::vector<double> share(values.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) share[at(v)] += piece_of(mesh, values, t).area() / 3;
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

void add_defects(const std::vector<int>& half_turns, PatternMeasures& m) {
  for (const int turns : half_turns) {
    if (turns > 0) m.defects.plus += static_cast<std::size_t>(turns);
    if (turns < 0) m.defects.minus += static_cast<std::size_t>(-turns);
  }
}

}  // namespace

double middle_level(std::vector<double> values) {
  constexpr double share = 0.005;
  const double low = quantile(values, share), high = quantile(values, 1 - share);
  return (low + high) / 2;
}

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
  const auto space = linear_space(mesh);
  const std::vector<Eigen::Matrix3d> tensors = slope_tensors(*space, mesh, values, m.wavelength / 2);
  const std::vector<Eigen::Vector3d> normals = area_normals(mesh);
  add_directions(mesh, values, tensors, normals, m);
  add_defects(half_turns(mesh, tensors, normals), m);
  m.spots = find_spots(mesh, values, m.level, m.above.parts >= m.below.parts);
  m.spectrum = spectrum(*space, values, 2 * std::numbers::pi / m.wavelength);
  return m;
}

}  // namespace pelage
