#include "measure/slopes.h"

#include <Eigen/Geometry>

#include "discretise/method.h"
#include "linalg/spd_factors.h"
#include "shape/topology.h"

namespace pelage {

namespace {
std::size_t at(Index i) { return static_cast<std::size_t>(i); }
}  // namespace

Eigen::Vector3d Piece::doubled_area() const {
  const Eigen::Vector3d a = corner.col(1) - corner.col(0), b = corner.col(2) - corner.col(0);
  return a.cross(b);
}

Eigen::Vector3d Piece::gradient() const {
  const Eigen::Vector3d n = doubled_area();
  if (!(n.squaredNorm() > 0)) return Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) sum += value[k] * (corner.col((k + 2) % 3) - corner.col((k + 1) % 3));
  return n.cross(sum) / n.squaredNorm();
}

Piece piece_of(const TriangleMesh& mesh, const std::vector<double>& values, const Triangle& t) {
  Piece piece;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const std::size_t v = at(t[static_cast<std::size_t>(k)]);
    piece.corner.col(k) = Eigen::Vector3d::Map(mesh.points[v].data());
    piece.value[k] = values[v];
  }
  return piece;
}

std::shared_ptr<const Space> linear_space(const TriangleMesh& mesh) {
  const auto topology = std::make_shared<const Topology>(make_topology(mesh.points.size(), mesh.triangles));
  return linear_method.make_space(topology, mesh.points);
}

std::vector<Eigen::Matrix3d> slope_tensors(const Space& space, const TriangleMesh& mesh,
                                           const std::vector<double>& values, double sigma) {
  const auto vertices = static_cast<Index>(values.size());
  std::vector<Vector> load(6, Vector::Zero(vertices));
  for (const Triangle& t : mesh.triangles) {
    const Piece piece = piece_of(mesh, values, t);
    const Eigen::Matrix3d tensor = piece.gradient() * piece.gradient().transpose() * (piece.area() / 3);
    for (const Index v : t)
      for (Eigen::Index i = 0, k = 0; i < 3; ++i)
        for (Eigen::Index j = i; j < 3; ++j, ++k) load[static_cast<std::size_t>(k)][v] += tensor(i, j);
  }
  const SparseMatrix mass = *space.sampled(SampleRule::quadrature).mass;
  const auto step = std::make_shared<SparseMatrix>(mass);
  combine(1, mass, sigma * sigma / 2, *space.stiffness(), *step);
  const auto solve = spd_inverse(step);
  std::vector<Eigen::Matrix3d> tensors(values.size());
  for (Eigen::Index i = 0, k = 0; i < 3; ++i)
    for (Eigen::Index j = i; j < 3; ++j, ++k) {
      const Vector x = solve(load[static_cast<std::size_t>(k)]);
      for (std::size_t v = 0; v < tensors.size(); ++v)
        tensors[v](i, j) = tensors[v](j, i) = x[static_cast<Eigen::Index>(v)];
    }
  return tensors;
}

std::vector<Eigen::Vector3d> area_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.points.size(), Eigen::Vector3d::Zero());
  const std::vector<double> nothing(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d n = piece_of(mesh, nothing, t).doubled_area();
    for (const Index v : t) normals[at(v)] += n;
  }
  return normals;
}

}  // namespace pelage
