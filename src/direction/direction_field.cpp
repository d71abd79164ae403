#include "direction/direction_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/checked.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using std::numbers::pi;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Obtuse triangles give edges of negative cotangent weight, with which A would have directions of negative energy.
/// They keep this share of an equilateral edge instead: singularities move by less than an edge.
constexpr double smallest_weight = 0.05;

std::vector<PlaneLink> links(const Connection& c) {
  std::vector<PlaneLink> list;
  for (Index h = 0; at(h) < c.transport.size(); ++h) {
    const Index twin = c.topology.twin[at(h)];
    if (twin >= 0 && twin < h) continue;
    const double w = c.cotangent[at(h)] + (twin >= 0 ? c.cotangent[at(twin)] : 0);
    list.push_back({c.topology.origin(h), c.topology.target(h), std::max(w, smallest_weight), c.transport[at(h)]});
  }
  return list;
}

/// Places of the 2 x 2 blocks: unknowns 2 v and 2 v + 1 are the real and the imaginary part at vertex v.
std::shared_ptr<const SparsePattern> block_pattern(Index vertices, const std::vector<PlaneLink>& list) {
  std::vector<std::vector<Index>> near(at(vertices));
  for (Index v = 0; v < vertices; ++v) near[at(v)].push_back(v);
  for (const PlaneLink& l : list) {
    near[at(l.from)].push_back(l.to);
    near[at(l.to)].push_back(l.from);
  }
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = 2 * vertices;
  for (auto& row : near) {
    std::sort(row.begin(), row.end());
    for (int part = 0; part < 2; ++part) {
      for (const Index v : row) pattern->column.insert(pattern->column.end(), {2 * v, 2 * v + 1});
      pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
    }
  }
  return pattern;
}

/// A += the real form of `value` in row i, column j of the complex matrix.
void add(SparseMatrix& a, Index i, Index j, std::complex<double> value) {
  const auto entry = [&](Index r, Index c) -> double& {
    return a.value[static_cast<std::size_t>(a.pattern->find(r, c))];
  };
  entry(2 * i, 2 * j) += value.real();
  entry(2 * i + 1, 2 * j + 1) += value.real();
  entry(2 * i, 2 * j + 1) -= value.imag();
  entry(2 * i + 1, 2 * j) += value.imag();
}

/// A of z'Az = sum w |z_to - exp(i n transport) z_from|^2.
SparseMatrix connection_laplacian(Index vertices, const std::vector<PlaneLink>& list, int n) {
  SparseMatrix a = zeros(block_pattern(vertices, list));
  for (const PlaneLink& l : list) {
    add(a, l.from, l.from, l.weight);
    add(a, l.to, l.to, l.weight);
    add(a, l.to, l.from, -std::polar(l.weight, n * l.transport));
    add(a, l.from, l.to, -std::polar(l.weight, -n * l.transport));
  }
  return a;
}

/// The piece of the mesh that each vertex belongs to: the smallest vertex number in it.
std::vector<Index> pieces(Index vertices, const std::vector<PlaneLink>& list) {
  std::vector<Index> parent(at(vertices));
  for (Index v = 0; v < vertices; ++v) parent[at(v)] = v;
  const auto root = [&](Index v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  for (const PlaneLink& l : list) {
    const Index a = root(l.from), b = root(l.to);
    parent[at(std::max(a, b))] = std::min(a, b);
  }
  for (Index v = 0; v < vertices; ++v) parent[at(v)] = root(v);
  return parent;
}

void add_to_diagonal(SparseMatrix& a, const Vector& values) {
  for (Index i = 0; i < a.rows(); ++i) a.value[static_cast<std::size_t>(a.pattern->find(i, i))] += values[i];
}

/// Both parts of a vertex.
Vector twice(const std::vector<double>& values) {
  Vector both(2 * std::ssize(values));
  for (Index i = 0; i < both.size(); ++i) both[i] = values[at(i / 2)];
  return both;
}

class Solver {
 public:
  Solver(const TangentPlanes& planes, const std::vector<PlaneLink>& links, int n)
      : c_(planes), n_(n), laplacian_(connection_laplacian(planes.places(), links, n)) {
    mass_ = twice(c_.area);
    const double floor = 1e-12 * mass_.sum() / static_cast<double>(mass_.size());
    mass_ = mass_.cwiseMax(floor);
    piece_ = pieces(planes.places(), links);
  }

  Vector solve(const std::vector<Guide>& guides) {
    Vector wish = Vector::Zero(mass_.size()), pull = wish;
    for (const Guide& g : guides) add_wish(g, wish, pull);
    std::vector<char> guided(piece_.size(), 0);
    for (const Guide& g : guides) guided[at(piece_[at(g.vertex)])] = 1;
    const auto free = [&](Index v) { return !guided[at(piece_[at(v)])]; };
    Vector z = Vector::Zero(mass_.size());
    if (!guides.empty()) z = guided_field(wish, pull, free);
    bool any_free = false;
    for (Index v = 0; v < std::ssize(piece_); ++v) any_free = any_free || free(v);
    if (any_free) {
      const Vector smooth = smoothest();
      for (Index i = 0; i < z.size(); ++i)
        if (free(i / 2)) z[i] = smooth[i];
    }
    return z;
  }

  double roughness(const Vector& z) const { return dot(z, laplacian_ * z) / dot(z, mass_.cwiseProduct(z)); }
  int iterations() const { return iterations_; }

 private:
  void add_wish(const Guide& g, Vector& wish, Vector& pull) const {
    // An exact wish is so many times as strong as the edges of its vertex: followed to a twentieth of a degree, while
    // the residual of the solve still tells about places far away from it.
    constexpr double exactly = 1e3;
    const double angle = n_ * c_.angle(g.vertex, g.direction);
    const double edges =
        laplacian_.value[static_cast<std::size_t>(laplacian_.pattern->find(2 * g.vertex, 2 * g.vertex))];
    const double weight = std::isfinite(g.weight) ? g.weight * mass_[2 * g.vertex] : exactly * edges;
    wish[2 * g.vertex] += weight * std::cos(angle);
    wish[2 * g.vertex + 1] += weight * std::sin(angle);
    pull[2 * g.vertex] += weight;
    pull[2 * g.vertex + 1] += weight;
  }

  void solve(const SparseMatrix& a, const Vector& b, Vector& z, double tolerance) {
    ConjugateGradientWork<Vector> work;
    const SolveReport report = conjugate_gradient(a, Jacobi(diagonal(a)), b, z, nullptr,
                                                  {.tolerance = tolerance, .max_iterations = 100000}, work);
    iterations_ += report.iterations;
    if (!report.converged)
      throw Error(Fault::numerics, "the direction field was not found: the solve did not converge");
  }

  /// (A + W) z = W wish. Far from all wishes z is small, but its angle still counts: hence the tight tolerance. Pieces
  /// without wishes get a unit matrix.
  template <class Free>
  Vector guided_field(const Vector& wish, const Vector& pull, const Free& free) {
    SparseMatrix a = laplacian_;
    Vector added = pull;
    for (Index i = 0; i < added.size(); ++i)
      if (free(i / 2)) added[i] += mass_[i];
    add_to_diagonal(a, added);
    Vector z = Vector::Zero(wish.size());
    solve(a, wish, z, 1e-13);
    return z;
  }

  /// Each piece by itself to length 1 in the mass.
  void normalise(Vector& z) const {
    std::vector<double> square(piece_.size(), 0.0);
    for (Index i = 0; i < z.size(); ++i) square[at(piece_[at(i / 2)])] += mass_[i] * z[i] * z[i];
    for (Index i = 0; i < z.size(); ++i)
      if (const double s = square[at(piece_[at(i / 2)])]; s > 0) z[i] /= std::sqrt(s);
  }

  /// Some field that depends on the form of the surface alone: the projection of a vector in space that turns with the
  /// normal. Of a symmetric surface many fields are as smooth as each other, and this chooses one.
  Vector beginning() const {
    Vector z(mass_.size());
    for (Index v = 0; v < std::ssize(piece_); ++v) {
      const Point& n = c_.normal[at(v)];
      const Point a = {std::sin(2.3 * n[1] + 1) + 0.4, std::sin(1.9 * n[2] + 2) - 0.3, std::sin(2.7 * n[0] + 3) + 0.2};
      const double along = dot(a, n), angle = n_ * c_.angle(v, a);
      const double projected = std::sqrt(std::max(0.0, dot(a, a) - along * along));
      z[2 * v] = projected * std::cos(angle);
      z[2 * v + 1] = projected * std::sin(angle);
    }
    return z;
  }

  /// Inverse iteration; all pieces at once, since A does not link them.
  Vector smoothest() {
    // A flat piece has the eigenvalue 0, so A is shifted by far less than any other: the eigenvectors stay.
    constexpr double shift = 1e-2;
    const double total = mass_.sum() / 2;
    SparseMatrix a = laplacian_;
    add_to_diagonal(a, shift / total * mass_);
    Vector z = beginning();
    normalise(z);
    constexpr int most_rounds = 30;
    constexpr double settled = 1e-4;  // relative change of the roughness: of fields about as smooth as each other, any
    double before = roughness(z);
    for (int round = 0; round < most_rounds; ++round) {
      const Vector b = mass_.cwiseProduct(z);
      Vector y = z / (before + shift / total);
      solve(a, b, y, 1e-2);  // the next round goes on from here
      normalise(y);
      z = y;
      const double now = roughness(z);
      if (std::abs(before - now) <= settled * (now + shift / total)) break;
      before = now;
    }
    return z;
  }

  const TangentPlanes& c_;
  int n_;
  SparseMatrix laplacian_;
  Vector mass_;
  std::vector<Index> piece_;
  int iterations_ = 0;
};

void check(Index places, int n, const std::vector<Guide>& guides) {
  if (n != 1 && n != 2 && n != 4)
    throw Error(Fault::usage, "a direction field has 1, 2 or 4 directions per vertex, not " + std::to_string(n));
  for (const Guide& g : guides)
    if (g.vertex < 0 || g.vertex >= places)
      throw Error(Fault::usage, "a direction is wished at vertex " + std::to_string(g.vertex) + "; the mesh has " +
                                    std::to_string(places) + ", counted from 0");
}

}  // namespace

std::vector<int> singularity_indices(const Connection& c, int n, const std::vector<double>& angle) {
  const auto turn = [&](Index h) {
    const Index a = c.topology.origin(h), b = c.topology.target(h);
    return std::remainder(n * (angle[at(b)] - angle[at(a)] - c.transport[at(h)]), 2 * pi);
  };
  // Of the two sides of an edge one speaks for both: where the turn is close to pi, rounding must not decide twice.
  const auto along = [&](Index h) {
    const Index twin = c.topology.twin[at(h)];
    return twin >= 0 && twin < h ? -turn(twin) : turn(h);
  };
  std::vector<int> index(c.topology.triangles.size());
  for (Index f = 0; f < std::ssize(index); ++f) {
    const double sum = along(3 * f) + along(3 * f + 1) + along(3 * f + 2) + n * c.curvature(f);
    index[at(f)] = saturated<int>(std::round(sum / (2 * pi)));
  }
  return index;
}

DirectionField direction_field(const TangentPlanes& planes, const std::vector<PlaneLink>& links, int n,
                               const std::vector<Guide>& guides) {
  check(planes.places(), n, guides);
  DirectionField field;
  field.n = n;
  if (planes.places() == 0) return field;
  Solver solver(planes, links, n);
  const Vector z = solver.solve(guides);
  for (Index v = 0; v < planes.places(); ++v) {
    field.angle.push_back(std::atan2(z[2 * v + 1], z[2 * v]) / n);
    field.direction.push_back(planes.tangent(v, field.angle.back()));
  }
  field.roughness = solver.roughness(z);
  field.iterations = solver.iterations();
  return field;
}

DirectionField direction_field(const Connection& c, int n, const std::vector<Guide>& guides) {
  DirectionField field = direction_field(c, links(c), n, guides);
  field.index = singularity_indices(c, n, field.angle);
  return field;
}

}  // namespace pelage
