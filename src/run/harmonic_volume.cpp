#include "run/harmonic_volume.h"

#include <string>

#include "base/number.h"
#include "base/parallel.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/locate.h"
#include "shape/tet_mesh.h"
#include "shape/tet_quality.h"

namespace pelage {

namespace {

/// Far below what a step of fairing moves.
constexpr double tolerance = 1e-8;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::vector<char> nodes_of_skin(const TetMesh& volume) {
  std::vector<char> skin(volume.nodes(), 0);
  for (const Triangle& t : mesh_of(volume).triangles)
    for (const Index node : t) skin[at(node)] = 1;
  return skin;
}

std::vector<MeshPlace> nearest_places(const std::vector<Point>& points, const std::vector<char>& wanted,
                                      const TriangleMesh& surface) {
  const SurfaceWalk walk(make_topology(surface.points.size(), surface.triangles), surface.points);
  std::vector<MeshPlace> places(points.size());
  parallel_for(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (wanted[k]) places[k] = walk.search(Eigen::Vector3d::Map(points[k].data()), Eigen::Vector3d::Zero());
  });
  return places;
}

}  // namespace

HarmonicVolume::HarmonicVolume(std::shared_ptr<const TetMesh> volume, std::shared_ptr<const TriangleMesh> surface,
                               SharedMatrix stiffness)
    : volume_(std::move(volume)),
      surface_(std::move(surface)),
      stiffness_(std::move(stiffness)),
      skin_(nodes_of_skin(*volume_)),
      nearest_(nearest_places(volume_->points, skin_, *surface_)) {}

std::vector<Point> HarmonicVolume::points(const std::vector<Point>& surface) const {
  const std::size_t nodes = volume_->nodes();
  std::vector<Point> result = volume_->points;
  const Jacobi<Vector> preconditioner(diagonal(*stiffness_));
  ConjugateGradientWork<Vector> work;
  const Vector nothing = Vector::Zero(static_cast<Eigen::Index>(nodes));
  for (std::size_t d = 0; d < 3; ++d) {
    Vector displacement = nothing;
    for (std::size_t k = 0; k < nodes; ++k)
      if (skin_[k])
        displacement[static_cast<Eigen::Index>(k)] = point_at(surface_->triangles, surface, nearest_[k])[d] -
                                                     point_at(surface_->triangles, surface_->points, nearest_[k])[d];
    const SolveReport solved =
        conjugate_gradient(*stiffness_, preconditioner, nothing, displacement, &skin_, {tolerance}, work);
    if (!solved.converged) throw Error(Fault::numerics, "the inside of the volume did not follow its surface");
    for (std::size_t k = 0; k < nodes; ++k) result[k][d] += displacement[static_cast<Eigen::Index>(k)];
  }
  require_upright(result);
  return result;
}

void HarmonicVolume::require_upright(const std::vector<Point>& points) const {
  std::size_t turned = 0;
  Point first{};
  for (const Tetrahedron& t : volume_->tets) {
    const Point &a = points[at(t[0])], &b = points[at(t[1])], &c = points[at(t[2])], &d = points[at(t[3])];
    if (signed_volume(a, b, c, d) > 0) continue;
    if (turned++ == 0) first = a;
  }
  if (turned == 0) return;
  throw Error(Fault::numerics, "the surface moves so far that " +
                                   (turned == 1 ? "a tetrahedron" : std::to_string(turned) + " tetrahedra") +
                                   " would be inside out, the first at (" + number(first[0], 4) + ", " +
                                   number(first[1], 4) + ", " + number(first[2], 4) +
                                   "); fair the shape before it is filled");
}

}  // namespace pelage
