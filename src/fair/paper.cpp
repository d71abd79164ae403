#include "fair/paper.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/quantile.h"
#include "base/suggest.h"
#include "discretise/curvature.h"
#include "discretise/sampling.h"
#include "fair/diffusivity.h"
#include "fair/faces.h"
#include "fair/flow.h"
#include "fair/normal_filter.h"
#include "fair/vertex_update.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"

namespace pelage {

namespace {

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

Eigen::Matrix3d as_matrix(const Tensor& t) {
  Eigen::Matrix3d m;
  m << t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5];
  return m;
}

/// Solves (M + tau K) x = M x0 for the three coordinates, by their steps x - x0: these do not depend on where the mesh
/// lies.
std::vector<Point> diffused(const SparseMatrix& mass, const SparseMatrix& stiffness, double tau,
                            const std::vector<Point>& points) {
  SparseMatrix matrix;
  combine(1, mass, tau, stiffness, matrix);
  std::vector<Point> result = points;
  for (std::size_t k = 0; k < 3; ++k) {
    Vector x(static_cast<Eigen::Index>(points.size()));
    for (Eigen::Index v = 0; v < x.size(); ++v) x[v] = points[at(v)][k];
    const Vector step = solve_spd(matrix, -tau * (stiffness * x), {.tolerance = 1e-8});
    for (Eigen::Index v = 0; v < x.size(); ++v) result[at(v)][k] += step[v];
  }
  return result;
}

/// a(x) at the vertices: the mean square of the edges around each, over that of the whole mesh.
Vector local_size(const Topology& topology, const std::vector<Point>& points) {
  Vector sum = Vector::Zero(topology.vertex_count), count = sum;
  for (Index h = 0; h < static_cast<Index>(topology.twin.size()); ++h) {
    const Index a = topology.origin(h), b = topology.target(h);
    const double square = (vector3(points[at(a)]) - vector3(points[at(b)])).squaredNorm();
    sum[a] += square, sum[b] += square, count[a] += 1, count[b] += 1;
  }
  const double mean = sum.sum() / count.sum();
  return sum.cwiseQuotient(count.cwiseMax(1)) / mean;
}

/// The filter of normals runs so often before curvatures are taken: with less, noise of 0.3 edges is taken for edges.
constexpr int filter_rounds = 5, vertex_rounds = 10, unfold_rounds = 5;
/// Bends per edge below this, 5 degrees, are never those of edges.
constexpr double least_bend = 5 * std::numbers::pi / 180;

struct PaperOptions {
  double tau = 0;
  std::optional<double> sigma, bend;  ///< in mean edges; radians per mean edge
  double mu = 0;
  bool full = false;  ///< motion in all directions
};

/// Anisotropic diffusion of the control points, eqs (18)-(21) of Bajaj, Zhang, Xu 2008:
///   (M_mu + tau K) x^(n+1) = M_mu x^n,  M_mu = (a^-mu phi, phi),  K = (a^(1-mu) D grad phi, grad phi).
/// What the paper leaves open: the curvatures in D are those of a filtered surface, of the bilateral filter that it
/// names (section 2), or of one implicit isotropic step of time sigma^2 / 2; lambda is the median curvature of that
/// surface, which edges exceed. Vertices move along the normals of that surface only, because motion along the surface
/// folds corners, unless all of the printed motion is wanted.
class Paper final : public FairMethod {
 public:
  Paper(const FairState& state, const PaperOptions& options)
      : discretisation_(loop_discretisation(state.topology)),
        assembler_(discretisation_),
        values_(quadrature_values(discretisation_)),
        size_(local_size(state.topology, state.points)),
        faces_of_vertex_(faces_of_vertices(state.topology)),
        filter_(state.topology, state.points),
        unfolding_(state.topology, state.points),
        options_(options) {}

  void step(FairState& s, FairReport& report) override {
    const double h = report.mean_edge;
    const std::vector<Point> smooth = options_.sigma ? blurred(s.points, *options_.sigma * h) : filtered(s);
    const PaperEquations e = equations(s.points, smooth, h);
    report.angle = e.bend * 180 / std::numbers::pi;
    const std::vector<Point> next = diffused(e.mass, e.stiffness, options_.tau * h * h, s.points);
    if (options_.full)
      move(s, next);
    else
      move_along_normals(s, next, smooth, report);
  }

  int most_steps() const override { return 12; }

  /// On the surface `points` with the curvatures of the surface `smooth`.
  PaperEquations equations(const std::vector<Point>& points, const std::vector<Point>& smooth, double edge) const {
    std::vector<Tensor> tensor = quadrature_curvature(discretisation_, smooth);
    const double bend = options_.bend.value_or(std::max(least_bend, edge * median_curvature(tensor)));
    diffuse_by(tensor, bend / edge);
    return {assembler_.mass(points, powers(-options_.mu)), assembler_.stiffness(points, tensor), bend};
  }

  /// The surface whose curvatures are taken.
  std::vector<Point> filtered(const FairState& s) {
    std::vector<Point> points = s.points;
    for (int round = 0; round < filter_rounds; ++round) {
      const std::vector<Vector3> normal = filter_.filter(face_geometry(s.topology.triangles, points));
      follow_normals(s.topology, faces_of_vertex_, normal, s.fixed, vertex_rounds, points);
      unfolding_.apply(faces_of_vertex_, normal, s.fixed, unfold_rounds, points);
    }
    return points;
  }

 private:
  std::vector<Point> blurred(const std::vector<Point>& points, double width) const {
    return diffused(assembler_.mass(points), assembler_.stiffness(points), width * width / 2, points);
  }

  static void move(FairState& s, const std::vector<Point>& next) {
    for (std::size_t v = 0; v < s.points.size(); ++v)
      if (!s.fixed[v]) s.points[v] = next[v];
  }

  void move_along_normals(FairState& s, const std::vector<Point>& next, const std::vector<Point>& smooth,
                          FairReport& report) const {
    const std::vector<Point> normal = limit_normals(discretisation_, smooth);
    for (std::size_t v = 0; v < s.points.size(); ++v) {
      if (s.fixed[v]) continue;
      const Vector3 n = vector3(normal[v]);
      const double along = n.dot(vector3(next[v]) - vector3(s.points[v]));
      for (std::size_t k = 0; k < 3; ++k) s.points[v][k] += along * normal[v][k];
    }
    report.folded = unfolding_.apply(faces_of_vertex_, face_geometry(s.topology.triangles, smooth).normal, s.fixed,
                                     unfold_rounds, s.points);
  }

  /// a^exponent at the quadrature points.
  std::vector<double> powers(double exponent) const {
    const Vector a = values_ * size_;
    std::vector<double> result(at(a.size()));
    for (Eigen::Index q = 0; q < a.size(); ++q) result[at(q)] = std::pow(a[q], exponent);
    return result;
  }

  static double median_curvature(const std::vector<Tensor>& curvature) {
    std::vector<double> all(curvature.size());
    for (std::size_t q = 0; q < all.size(); ++q) all[q] = as_matrix(curvature[q]).norm();
    return all.empty() ? 0 : quantile(all, 0.5);
  }

  /// Makes a^(1-mu) D of the curvatures.
  void diffuse_by(std::vector<Tensor>& tensor, double lambda) const {
    const std::vector<double> factor = powers(1 - options_.mu);
    parallel_for(tensor.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t q = begin; q < end; ++q)
        tensor[q] = diffusion_tensor(as_matrix(tensor[q]), [&](double k) { return factor[q] * throttle(k, lambda); });
    });
  }

  Discretisation discretisation_;
  Assembler assembler_;
  SparseMatrix values_;
  Vector size_;
  FaceLists faces_of_vertex_;
  NormalFilter filter_;
  Unfolding unfolding_;
  PaperOptions options_;
};

}  // namespace

PaperEquations paper_equations(const FairState& state) {
  Paper paper(state, {});
  return paper.equations(state.points, paper.filtered(state), mean_edge(state.topology, state.points));
}

std::unique_ptr<FairMethod> make_paper_method(const FairState& state, const FairOptions& options, FairReport& report) {
  static const std::vector<std::string> motions = {"normal", "full"};
  if (std::ranges::find(motions, options.motion) == motions.end())
    throw Error(Fault::usage, unknown_name("motion", options.motion, motions));
  report.tau = options.tau.value_or(0.2);
  report.sigma = options.sigma.value_or(0);
  PaperOptions chosen{report.tau, options.sigma, {}, options.mu, options.motion == "full"};
  if (options.angle) chosen.bend = *options.angle * std::numbers::pi / 180;
  return std::make_unique<Paper>(state, chosen);
}

}  // namespace pelage
