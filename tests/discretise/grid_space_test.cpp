// Multilinear elements on grids: identities, orders, and eigenvalues from another derivation.

#include "discretise/grid_space.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/dense.h"
#include "base/parallel.h"
#include "base/random.h"
#include "discretise/anisotropy.h"
#include "discretise/method.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/grid.h"
#include "shape/vectors.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using std::numbers::pi;
using testing::dense;

Eigen::Vector3d vector(const Point& p) { return {p[0], p[1], p[2]}; }
Eigen::Matrix3d matrix(const Tensor& t) {
  return (Eigen::Matrix3d() << t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5]).finished();
}

Grid even_grid(std::array<std::int32_t, 3> count, bool periodic = false) {
  Grid g;
  g.count = count;
  for (std::size_t a = 0; a < 3; ++a) g.periodic[a] = periodic && count[a] > 1;
  g.spacing = {0.5, 0.4, 0.3};
  g.origin = {1, -2, 3};
  return g;
}

/// With nodes moved at random by up to a quarter of the spacing along all of the grid's axes.
Grid shaken(Grid g) {
  std::vector<Point> points;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(g.nodes()); ++v) {
    Point p = g.point(v);
    for (std::size_t a = 0; a < static_cast<std::size_t>(g.dimension()); ++a)
      p[a] += g.spacing[a] / 2 * (uniform(7, 3 * static_cast<std::uint64_t>(v) + a) - 0.5);
    points.push_back(p);
  }
  for (std::size_t a = 0; a < 3; ++a) g.period[a][a] = g.spacing[a] * g.count[a];
  g.points = std::move(points);
  return g;
}

constexpr std::array<std::array<std::int32_t, 3>, 3> small_counts = {{{7, 1, 1}, {6, 5, 1}, {5, 4, 6}}};

/// In the axes of the grid's own dimension.
Tensor full_tensor(int dimension) {
  if (dimension == 1) return {2, 0, 0, 0, 0, 0};
  if (dimension == 2) return {2, -0.7, 0, 1, 0, 0};
  return {2, -0.7, 0.3, 1, 0.2, 1.5};
}

std::size_t quadrature_count(const Space& s) {
  return static_cast<std::size_t>(s.sampled(SampleRule::quadrature).sampling->count());
}

/// Volumes of all hexahedra by splitting each face's map: the integral of div x / 3, by Gauss points of each cell.
double expected_measure(const Grid& g) {
  if (g.dimension() == 1) return g.points.back()[0] - g.points.front()[0];
  double measure = 0;
  if (g.dimension() == 2) {  // the shoelace formula around the border
    std::vector<std::int32_t> border;
    const auto [nx, ny, nz] = g.count;
    for (std::int32_t i = 0; i < nx; ++i) border.push_back(g.node(i, 0, 0));
    for (std::int32_t j = 1; j < ny; ++j) border.push_back(g.node(nx - 1, j, 0));
    for (std::int32_t i = nx - 2; i >= 0; --i) border.push_back(g.node(i, ny - 1, 0));
    for (std::int32_t j = ny - 2; j > 0; --j) border.push_back(g.node(0, j, 0));
    for (std::size_t k = 0; k < border.size(); ++k) {
      const Point a = g.point(border[k]), b = g.point(border[(k + 1) % border.size()]);
      measure += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    return measure;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(GridSpace, LinearFunctionsHaveTheirEnergyAndNoResidualOnDistortedGrids) {
  for (const auto& count : small_counts) {
    const Grid g = shaken(even_grid(count));
    const int d = g.dimension();
    const GridSpace space(g);
    const Tensor t = full_tensor(d);
    const SparseMatrix k = space.stiffness(std::vector<Tensor>(quadrature_count(space), t));
    const Vector mass = *space.sampled(SampleRule::vertices).mass * Vector::Ones(space.unknowns());
    const double measure = mass.sum();
    if (d < 3) {
      EXPECT_NEAR(measure, expected_measure(g), 1e-12);
    }
    EXPECT_LT((k * Vector(Vector::Ones(space.unknowns()))).lpNorm<Eigen::Infinity>(), 1e-12);
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b) {
        Vector u(space.unknowns()), v(space.unknowns());
        for (Index i = 0; i < space.unknowns(); ++i) {
          u[i] = g.point(i)[static_cast<std::size_t>(a)];
          v[i] = g.point(i)[static_cast<std::size_t>(b)];
        }
        const Vector ku = k * u;
        EXPECT_NEAR(v.dot(ku), measure * matrix(t)(a, b), 1e-12 * measure * 10) << d << a << b;
        for (Index i = 0; i < space.unknowns(); ++i) {
          const std::array<std::int32_t, 3> place = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
          bool inside = true;
          for (std::size_t c = 0; c < static_cast<std::size_t>(d); ++c)
            inside &= place[c] > 0 && place[c] + 1 < count[c];
          if (inside) {
            EXPECT_NEAR(ku[i], 0, 1e-12) << d;
          }
        }
      }
  }
}

TEST(GridSpace, HexahedraThatFillABoxHaveItsVolume) {
  Grid g = shaken(even_grid({5, 4, 6}));
  const Grid even = even_grid({5, 4, 6});
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(g.nodes()); ++v) {  // nodes of the border stay in its planes
    const std::array<std::int32_t, 3> place = {v % 5, v / 5 % 4, v / 20};
    for (std::size_t a = 0; a < 3; ++a)
      if (place[a] == 0 || place[a] + 1 == g.count[a]) g.points[static_cast<std::size_t>(v)][a] = even.point(v)[a];
  }
  const GridSpace space(g);
  EXPECT_NEAR(sum(*space.sampled(SampleRule::vertices).mass * Vector(Vector::Ones(space.unknowns()))),
              4 * 0.5 * 3 * 0.4 * 5 * 0.3, 1e-12);
}

TEST(GridSpace, MatricesAreSymmetricAndNotNegative) {
  for (const bool periodic : {false, true})
    for (const auto& count : small_counts) {
      const GridSpace space(shaken(even_grid(count, periodic)));
      const std::size_t q = quadrature_count(space);
      std::vector<Tensor> tensors(q);
      std::vector<double> numbers(q);
      for (std::size_t k = 0; k < q; ++k) {
        Eigen::Matrix3d root;
        for (int i = 0; i < 9; ++i) root(i) = uniform(3, 9 * k + static_cast<std::uint64_t>(i)) - 0.5;
        const Eigen::Matrix3d t = root * root.transpose();
        tensors[k] = {t(0, 0), t(0, 1), t(0, 2), t(1, 1), t(1, 2), t(2, 2)};
        numbers[k] = uniform(4, k);
      }
      const Eigen::MatrixXd mass = dense(*space.sampled(SampleRule::vertices).mass);
      EXPECT_GT(symmetric_modes(mass).values.minCoeff(), 0);
      for (const SparseMatrix& m : {*space.stiffness(), space.stiffness(tensors), space.stiffness(numbers),
                                    space.weighted_mass(numbers), *space.sampled(SampleRule::vertices).mass}) {
        const Eigen::MatrixXd a = dense(m);
        EXPECT_EQ((a - a.transpose()).norm(), 0);
        EXPECT_GT(symmetric_modes(a).values.minCoeff(), -1e-12);
      }
    }
}

/// k^2 of a wave on a periodic even grid as the matrices see it, relative to the true one: less 1.
double dispersion_error(int dimension, std::int32_t n, const Eigen::Matrix3d& axes) {
  Grid g;
  Eigen::Vector3d k = Eigen::Vector3d::Zero();
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    g.count[a] = n;
    g.periodic[a] = true;
    g.spacing[a] = std::array{1.0, 1.3, 0.8}[a] / n;
    k[static_cast<int>(a)] = 2 * pi * std::array{1, 2, -1}[a] / (n * g.spacing[a]);
  }
  const GridSpace space(g);
  Tensor t{axes(0, 0), axes(0, 1), axes(0, 2), axes(1, 1), axes(1, 2), axes(2, 2)};
  const SparseMatrix stiffness = space.stiffness(std::vector<Tensor>(quadrature_count(space), t));
  Vector wave(space.unknowns());
  for (Index i = 0; i < space.unknowns(); ++i) wave[i] = std::cos(k.dot(vector(g.point(i))));
  return Vector(stiffness * wave)[0] / Vector(*space.sampled(SampleRule::vertices).mass * wave)[0] / (k.dot(axes * k)) -
         1;
}

TEST(GridSpace, WavesOnEvenGridsKeepTheirSquareToTheFourthOrder) {
  const Eigen::Matrix3d along = Eigen::Vector3d(1, 2.5, 0.7).asDiagonal();
  for (int d = 1; d <= 3; ++d)
    for (const Eigen::Matrix3d& t : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), along}) {
      const double coarse = dispersion_error(d, 16, t), fine = dispersion_error(d, 32, t);
      EXPECT_LT(std::abs(coarse), 5e-3);
      EXPECT_NEAR(std::log2(coarse / fine), 4, 0.15) << d;
    }
  Eigen::Matrix3d across = along;
  across(0, 1) = across(1, 0) = 0.9;
  EXPECT_NEAR(std::log2(dispersion_error(2, 16, across) / dispersion_error(2, 32, across)), 2, 0.15);
}

// Manufactured solutions on maps of periodic parameters: u - (1/sqrt(g)) d_a (sqrt(g) T^ab d_b u) = f, with f from
// differences of fourth order in the parameters, which know nothing of elements.

using Place = Eigen::Vector3d;

struct Manufactured {
  int dimension;
  std::function<Place(const Place&)> map;  ///< of parameters of period 1
  std::function<double(const Place&)> u;   ///< of places
  std::function<Eigen::Matrix3d(const Place&)> tensor;
  std::array<Point, 3> period{};
};

template <class F>
auto slope(const F& f, const Place& at, int axis) {
  const double h = 1e-3;
  const Place e = Place::Unit(axis) * h;
  using Value = std::decay_t<decltype(f(at))>;
  return Value((8 * (f(at + e) - f(at - e)) - (f(at + 2 * e) - f(at - 2 * e))) / (12 * h));
}

double right_side(const Manufactured& m, const Place& at) {
  const int d = m.dimension;
  const auto jacobian = [&](const Place& p) {
    Eigen::MatrixXd t(3, d);
    for (int a = 0; a < d; ++a) t.col(a) = slope(m.map, p, a);
    return t;
  };
  const auto root_g = [&](const Place& p) {
    const Eigen::MatrixXd t = jacobian(p);
    return std::sqrt((t.transpose() * t).determinant());
  };
  double divergence = 0;
  for (int a = 0; a < d; ++a)
    divergence += slope(
        [&](const Place& p) {
          const Eigen::MatrixXd t = jacobian(p), dual = t * (t.transpose() * t).inverse();
          double flux = 0;
          for (int b = 0; b < d; ++b)
            flux += dual.col(a).dot(m.tensor(m.map(p)) * dual.col(b)) *
                    slope([&](const Place& q) { return m.u(m.map(q)); }, p, b);
          return flux * root_g(p);
        },
        at, a);
  return m.u(m.map(at)) - divergence / root_g(at);
}

double manufactured_error(const Manufactured& m, std::int32_t n) {
  Grid g;
  std::vector<Place> parameter;
  for (std::size_t a = 0; a < static_cast<std::size_t>(m.dimension); ++a) {
    g.count[a] = n;
    g.periodic[a] = true;
  }
  g.period = m.period;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(g.nodes()); ++v) {
    parameter.push_back(Place(v % n, v / n % g.count[1], v / n / g.count[1]) / n);
    const Place x = m.map(parameter.back());
    g.points.push_back({x[0], x[1], x[2]});
  }
  const GridSpace space(g);
  const SampledMass sampled = space.sampled(SampleRule::vertices);
  std::vector<Tensor> tensors;
  for (const Point& p : space.geometry(SampleRule::quadrature, false).position) {
    const Eigen::Matrix3d t = m.tensor(vector(p));
    tensors.push_back({t(0, 0), t(0, 1), t(0, 2), t(1, 1), t(1, 2), t(2, 2)});
  }
  SparseMatrix a = space.stiffness(tensors);
  combine(1, a, 1, *sampled.mass, a);
  Vector f(space.unknowns()), u(space.unknowns());
  for (Index i = 0; i < space.unknowns(); ++i) {
    f[i] = right_side(m, parameter[static_cast<std::size_t>(i)]);
    u[i] = m.u(vector(g.point(i)));
  }
  const Vector solved = solve_spd(a, load(*sampled.sampling, f), {.tolerance = 1e-12});
  return (solved - u).lpNorm<Eigen::Infinity>();
}

Eigen::Matrix3d varying_tensor(const Place& x) {
  Eigen::Matrix3d root;
  root << 1, 0.3 * std::sin(2 * pi * x[0]), 0.2, 0.4 * std::cos(2 * pi * x[1]), 1.2, -0.3, 0.1,
      0.3 * std::sin(2 * pi * (x[1] + x[2])), 0.8;
  return root * root.transpose() / 10;
}

double wave_of_place(const Place& x) {
  return std::sin(2 * pi * x[0]) * std::cos(2 * pi * x[1]) + 0.5 * std::sin(2 * pi * (x[2] + x[1]));
}

/// A distorted tile, or block, of period 1.
Place distorted(const Place& p, int dimension) {
  Place x = p;
  x[0] += 0.08 * std::sin(2 * pi * (p[0] + p[1]));
  x[1] += 0.06 * std::sin(2 * pi * (p[1] - p[0]) + 1) * (dimension > 1);
  if (dimension == 3) {
    x[2] += 0.05 * std::sin(2 * pi * (p[0] + p[2]));
    x[0] += 0.04 * std::cos(2 * pi * p[2]);
  }
  return x;
}

constexpr std::array<Point, 3> unit_period = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

TEST(GridSpace, SolutionsConvergeWithTheSecondOrderOnADistortedTile) {
  const Manufactured m{2, [](const Place& p) { return distorted(p, 2); }, wave_of_place, varying_tensor, unit_period};
  const double coarse = manufactured_error(m, 32), fine = manufactured_error(m, 64);
  EXPECT_LT(fine, 0.02);
  EXPECT_GE(std::log2(coarse / fine), 1.9) << coarse << " " << fine;
}

TEST(GridSpace, SolutionsConvergeWithTheSecondOrderOnATorus) {
  const auto torus = [](const Place& p) -> Place {
    const Place q = distorted(p, 2);
    const double w = 1 + 0.4 * std::cos(2 * pi * q[1]);
    return Place(w * std::cos(2 * pi * q[0]), w * std::sin(2 * pi * q[0]), 0.4 * std::sin(2 * pi * q[1])) / 4;
  };
  const Manufactured m{2, torus, wave_of_place, varying_tensor, {}};
  const double coarse = manufactured_error(m, 48), fine = manufactured_error(m, 96);
  EXPECT_LT(fine, 0.02);
  EXPECT_GE(std::log2(coarse / fine), 1.9) << coarse << " " << fine;
}

TEST(GridSpace, SolutionsConvergeWithTheSecondOrderOnADistortedBlock) {
  const Manufactured m{3, [](const Place& p) { return distorted(p, 3); }, wave_of_place, varying_tensor, unit_period};
  const double coarse = manufactured_error(m, 16), fine = manufactured_error(m, 32);
  EXPECT_LT(fine, 0.1);
  EXPECT_GE(std::log2(coarse / fine), 1.9) << coarse << " " << fine;
}

TEST(GridSpace, SolutionsConvergeWithTheSecondOrderOnAKnot) {
  const auto knot = [](const Place& p) -> Place {
    const double t = 2 * pi * (p[0] + 0.05 * std::sin(2 * pi * p[0]));
    return Place(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)) / 8;
  };
  const Manufactured m{1, knot, wave_of_place, varying_tensor, {}};
  const double coarse = manufactured_error(m, 100), fine = manufactured_error(m, 200);
  EXPECT_LT(fine, 0.02);
  EXPECT_GE(std::log2(coarse / fine), 1.9) << coarse << " " << fine;
}

/// The grid of an uneven torus of radii 1 and r, n nodes around and n / 2 around the tube.
Grid torus_grid(std::int32_t n, double r) {
  Grid g;
  g.count = {n, n / 2, 1};
  g.periodic = {true, true, false};
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(g.nodes()); ++v) {
    const double phi = 2 * pi * (v % n) / n, theta = 4 * pi * (v / n) / n + 0.1 * std::sin(phi),
                 w = 1 + r * std::cos(theta);
    g.points.push_back({w * std::cos(phi), w * std::sin(phi), r * std::sin(theta)});
  }
  return g;
}

/// Eigenvalues of the waves around the torus with m periods, from Fourier collocation around the tube:
/// -(w f')' / (r^2 w) + m^2 / w^2 f = lambda f.
Eigen::VectorXd torus_eigenvalues(double r, int m) {
  constexpr int n = 41;
  Eigen::MatrixXd d(n, n);
  Eigen::VectorXd w(n);
  for (int i = 0; i < n; ++i) {
    w[i] = 1 + r * std::cos(2 * pi * i / n);
    for (int j = 0; j < n; ++j) d(i, j) = i == j ? 0 : ((i - j) % 2 == 0 ? 0.5 : -0.5) / std::sin(pi * (i - j) / n);
  }
  const Eigen::MatrixXd k = d.transpose() * w.asDiagonal() * d / (r * r) +
                            Eigen::MatrixXd(Eigen::VectorXd(m * m * w.cwiseInverse()).asDiagonal());
  const Eigen::MatrixXd mass = w.asDiagonal();
  return symmetric_modes(k, mass).values;
}

TEST(GridSpace, ATorusHasItsAreaAndItsEigenvalues) {
  const double r = 0.5;
  std::vector<double> expected = {torus_eigenvalues(r, 0)[1]};
  for (const int m : {1, 2})
    for (int twice = 0; twice < 2; ++twice) expected.push_back(torus_eigenvalues(r, m)[0]);
  std::ranges::sort(expected);
  std::array<Eigen::VectorXd, 2> error;
  std::array<double, 2> area_error{};
  for (std::size_t k = 0; k < 2; ++k) {
    const GridSpace space(torus_grid(k == 0 ? 20 : 40, r));
    const Eigen::MatrixXd mass = dense(*space.sampled(SampleRule::vertices).mass),
                          stiffness = dense(*space.stiffness());
    area_error[k] = mass.sum() - 4 * pi * pi * r;
    const Eigen::VectorXd all = symmetric_modes(stiffness, mass).values;
    error[k].resize(4);
    for (int i = 0; i < 4; ++i) error[k][i] = std::abs(all[i + 1] / expected[static_cast<std::size_t>(i)] - 1);
  }
  EXPECT_NEAR(std::log2(area_error[0] / area_error[1]), 2, 0.1);
  EXPECT_LT(error[1].maxCoeff(), 0.02);
  EXPECT_GE(std::log2(error[0].maxCoeff() / error[1].maxCoeff()), 1.9)
      << error[0].transpose() << " / " << error[1].transpose();
}

TEST(GridSpace, PeriodicGridsAreOpenOnesInside) {
  for (const auto& count : small_counts)
    for (const bool even : {true, false}) {
      const Grid closed = even_grid(count), periodic = even_grid(count, true);
      const GridSpace a(even ? closed : shaken(closed)), b(even ? periodic : shaken(periodic));
      Vector u(a.unknowns());
      for (Index i = 0; i < a.unknowns(); ++i) u[i] = uniform(1, static_cast<std::uint64_t>(i));
      const Vector ku = *a.stiffness() * u - *b.stiffness() * u;
      const Vector mu = *a.sampled(SampleRule::vertices).mass * u - *b.sampled(SampleRule::vertices).mass * u;
      Index inside = 0;
      for (Index i = 0; i < a.unknowns(); ++i) {
        const std::array<std::int32_t, 3> place = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
        bool border = false;
        for (std::size_t c = 0; c < static_cast<std::size_t>(closed.dimension()); ++c)
          border |= place[c] == 0 || place[c] + 1 == count[c];
        if (border) continue;
        ++inside;
        EXPECT_NEAR(ku[i], 0, 1e-13);
        EXPECT_NEAR(mu[i], 0, 1e-13);
      }
      EXPECT_GT(inside, 0);
    }
}

/// Cosines that are flat at the borders of closed axes are eigenvectors: the borders are mirrors.
TEST(GridSpace, EvenGridsAreLatticesWithMirrors) {
  Grid g = even_grid({9, 8, 7});
  g.periodic[1] = true;
  const GridSpace space(g);
  ASSERT_NE(space.lattice(), nullptr);
  EXPECT_EQ(space.lattice()->count, (std::array<std::size_t, 3>{9, 8, 7}));
  EXPECT_EQ(space.lattice()->spacing, g.spacing);
  EXPECT_EQ(space.lattice()->periodic, g.periodic);
  Vector u(space.unknowns());
  for (Index v = 0; v < space.unknowns(); ++v)
    u[v] = std::cos(pi * 3 * (v % 9) / 8) * std::cos(2 * pi * 2 * (v / 9 % 8) / 8) * std::cos(pi * (v / 72) / 6);
  const Vector ku = *space.stiffness() * u, mu = *space.sampled(SampleRule::vertices).mass * u;
  EXPECT_LT((ku - ku[0] / mu[0] * mu).lpNorm<Eigen::Infinity>(), 1e-13);
  EXPECT_EQ(GridSpace(shaken(g)).lattice(), nullptr);
}

/// Values and derivatives of triangles' points belong to the surface that their corners span, whatever axes close.
TEST(GridSpace, TrianglesOfTheMeshKnowTheirCells) {
  Grid tile = even_grid({5, 6, 1}, true);
  for (const Grid& g : {even_grid({5, 6, 1}), tile, shaken(tile), torus_grid(8, 0.5)}) {
    const GridSpace space(g);
    const TriangleMesh mesh = mesh_of(g);
    const std::vector<Point>& x = space.control();
    const auto place = [&](Index face, double v, double w, Eigen::Index row) {
      const ElementPoint e = space.element_point(face, v, w);
      Place sum = Place::Zero();
      for (std::size_t k = 0; k < 4; ++k)
        sum += e.jet(row, static_cast<Eigen::Index>(k)) * vector(x[static_cast<std::size_t>(e.function[k])]);
      return sum;
    };
    for (Index f = 0; f < static_cast<Index>(mesh.triangles.size()); ++f) {
      const Triangle& t = mesh.triangles[static_cast<std::size_t>(f)];
      const std::array<std::array<double, 2>, 3> corner = {{{0, 0}, {1, 0}, {0, 1}}};
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT((place(f, corner[k][0], corner[k][1], 0) - vector(x[static_cast<std::size_t>(t[k])])).norm(), 1e-14);
      const double h = 1e-6;
      EXPECT_LT((place(f, 0.3, 0.2, 1) - (place(f, 0.3 + h, 0.2, 0) - place(f, 0.3 - h, 0.2, 0)) / (2 * h)).norm(),
                1e-8);
      EXPECT_LT((place(f, 0.3, 0.2, 2) - (place(f, 0.3, 0.2 + h, 0) - place(f, 0.3, 0.2 - h, 0)) / (2 * h)).norm(),
                1e-8);
    }
  }
}

TEST(GridSpace, GradientsOfLinearFunctionsAreExactEverywhere) {
  for (const auto& count : small_counts) {
    const Grid g = shaken(even_grid(count));
    const GridSpace space(g);
    Vector u(space.unknowns()), v(space.unknowns());
    Place p = Place::Zero(), q = p;
    for (int a = 0; a < g.dimension(); ++a) p[a] = 1 + a, q[a] = 3 - 2 * a;
    for (Index i = 0; i < space.unknowns(); ++i) u[i] = p.dot(vector(g.point(i))), v[i] = q.dot(vector(g.point(i)));
    for (const SampleRule rule : {SampleRule::vertices, SampleRule::quadrature}) {
      const Vector product = space.gradient_product(rule, u, v);
      EXPECT_EQ(product.size(), space.sampled(rule).sampling->count());
      EXPECT_LT((product.array() - p.dot(q)).abs().maxCoeff(), 1e-11);
    }
  }
}

TEST(GridSpace, SamplesAndQuadraturePointsAreWhereValuesSay) {
  for (const auto& count : small_counts)
    for (const bool even : {true, false}) {
      const Grid g = even ? even_grid(count) : shaken(even_grid(count));
      const GridSpace space(g);
      Vector u(space.unknowns());
      for (Index i = 0; i < space.unknowns(); ++i) u[i] = vector(g.point(i)).dot(Place(1, 2, -3));
      const SampledMass at_points = space.sampled(SampleRule::quadrature);
      const Vector values = space.quadrature_values() * u;
      const std::vector<double> same = space.at_quadrature_points({u.begin(), u.end()});
      for (Eigen::Index k = 0; k < values.size(); ++k) {
        EXPECT_NEAR(values[k], vector(at_points.sampling->position[static_cast<std::size_t>(k)]).dot(Place(1, 2, -3)),
                    1e-12);
        EXPECT_NEAR(values[k], same[static_cast<std::size_t>(k)], 1e-12);
      }
      const SampledMass at_nodes = space.sampled(SampleRule::vertices);
      EXPECT_TRUE(unknowns_are_samples(*at_nodes.sampling));
      EXPECT_LT((load(*at_nodes.sampling, u) - *at_nodes.mass * u).norm(), 1e-13);
      EXPECT_LT((dense(sampled_mass(*at_points.sampling, at_points.sampling->weight, at_points.mass->pattern)) -
                 dense(*at_points.mass))
                    .norm(),
                1e-13);
    }
}

/// A cylinder and a sphere bend away from the normals that their axes make.
TEST(GridSpace, CurvedSheetsKnowTheirNormalsAndCurvature) {
  const double r = 2;
  Grid cylinder;
  cylinder.count = {60, 9, 1};
  cylinder.periodic = {true, false, false};
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(cylinder.nodes()); ++v) {
    const double phi = 2 * pi * (v % 60) / 60;
    cylinder.points.push_back({r * std::cos(phi), r * std::sin(phi), 0.2 * (v / 60)});
  }
  const GridSpace space(cylinder);
  for (const SampleRule rule : {SampleRule::vertices, SampleRule::quadrature}) {
    const PlaceGeometry places = space.geometry(rule, true);
    for (std::size_t k = 0; k < places.position.size(); ++k) {
      const Place out = Place(places.position[k][0], places.position[k][1], 0).normalized();
      EXPECT_NEAR(vector(places.normal[k]).dot(out), 1, 2e-3);
      EXPECT_NEAR(places.curvature.k1[k], 1 / r, 2e-3);
      EXPECT_NEAR(places.curvature.k2[k], 0, 1e-12);
    }
  }
  EXPECT_EQ(GridSpace(even_grid({4, 5, 1})).geometry(SampleRule::vertices, true).normal[3], (Point{0, 0, 1}));
}

TEST(GridSpace, TensorsFollowLines) {
  const auto constant = [](const Space& space, double theta) {
    const std::size_t q = quadrature_count(space);
    return Kinetics::TensorField{std::vector(q, theta), std::vector(q, 2.0), std::vector(q, 0.5)};
  };
  const auto all_are = [](const std::vector<Tensor>& tensors, const Eigen::Matrix3d& expected) {
    for (const Tensor& t : tensors)
      if ((matrix(t) - expected).norm() > 1e-12) return false;
    return !tensors.empty();
  };
  const GridSpace sheet(even_grid({4, 5, 1})), block(even_grid({4, 5, 3})), line(even_grid({4, 1, 1}));
  const Place d(std::cos(0.7), std::sin(0.7), 0), n(-std::sin(0.7), std::cos(0.7), 0), e = Place(1, 2, 2) / 3;
  const auto lines = [](const Space& space, const Place& x) {
    return std::vector<Tensor>(static_cast<std::size_t>(space.unknowns()), line_tensor({x[0], x[1], x[2]}));
  };
  EXPECT_TRUE(all_are(sheet.tensors(lines(sheet, Place(std::cos(0.4), std::sin(0.4), 0)), constant(sheet, 0.3)),
                      4 * d * d.transpose() + 0.25 * n * n.transpose()));
  EXPECT_TRUE(all_are(block.tensors(lines(block, e), constant(block, 0)),
                      4 * e * e.transpose() + 0.25 * (Eigen::Matrix3d::Identity() - e * e.transpose())));
  EXPECT_TRUE(
      all_are(line.tensors(lines(line, e), constant(line, 0)), 4 * Place::UnitX() * Place::UnitX().transpose()));
  EXPECT_THROW(block.tensors(lines(block, e), constant(block, 0.1)), Error);
}

TEST(GridSpace, MovesAndKeepsItsConnectivity) {
  const Grid even = even_grid({5, 4, 1}, true);
  const GridSpace space(even);
  const Grid moved = shaken(even);
  const auto there = space.moved(moved.points);
  EXPECT_EQ(there->stiffness()->pattern, space.stiffness()->pattern);
  EXPECT_EQ(there->stiffness()->value, GridSpace(moved).stiffness()->value);
  EXPECT_EQ(there->control(), moved.points);
  std::vector<char> nodes(20, 1);
  nodes[6] = 0;
  const std::vector<char> inner = space.interior(nodes);
  EXPECT_EQ(std::ranges::count(inner, 1), 20 - 9);
}

TEST(GridSpace, SameBitsForAnyNumberOfThreads) {
  const Grid g = torus_grid(200, 0.5);
  const GridSpace several(g);
  const ThreadLimit limit(1);
  const GridSpace one(g);
  EXPECT_EQ(one.stiffness()->pattern->column, several.stiffness()->pattern->column);
  EXPECT_EQ(one.stiffness()->value, several.stiffness()->value);
  EXPECT_EQ(one.sampled(SampleRule::vertices).mass->value, several.sampled(SampleRule::vertices).mass->value);
}

TEST(GridSpace, GridsThatAreNotSoundAreRefused) {
  Grid g = even_grid({5, 4, 1});
  g.spacing[1] = 0;
  EXPECT_THROW(grid_method.make_node_space(g), Error);
}

}  // namespace
}  // namespace pelage
