#include "discretise/cell_space.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/random.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/cells.h"
#include "shape/generators.h"
#include "support/soups.h"

namespace pelage {
namespace {

Cells cells_on(const char* shape, std::size_t n) { return make_cells(shared(builtin_shape(shape)), n); }

Vector values(const Space& space, double (*f)(const Point&)) {
  Vector u(space.unknowns());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = f(space.control()[static_cast<std::size_t>(i)]);
  return u;
}

double asymmetry(const SparseMatrix& k) {
  const SparseMatrix t = transpose(k);
  double most = 0;
  for (std::size_t e = 0; e < k.value.size(); ++e) most = std::max(most, std::abs(k.value[e] - t.value[e]));
  return most;
}

std::vector<double> varying(const Space& space) {
  std::vector<double> c;
  for (const Point& p : space.control()) c.push_back(1 + 0.5 * p[0]);
  return c;
}

std::vector<Tensor> tensors(const CellSpace& space, double a1, double a2) {
  std::vector<Tensor> lines;
  for (std::size_t i = 0; i < space.cells().nodes(); ++i) {
    const Point n = space.cells().normals[i], across = cross(n, {0, 0, 1});
    const Point d = unit(length(across) > 0.01 ? across : Point{1, 0, 0});
    lines.push_back({d[0] * d[0], d[0] * d[1], d[0] * d[2], d[1] * d[1], d[1] * d[2], d[2] * d[2]});
  }
  const std::vector<double> zero(lines.size(), 0.0), one(lines.size(), a1), two(lines.size(), a2);
  return space.tensors(lines, {zero, one, two});
}

TEST(CellSpace, KeepsConstantsAndIsSymmetric) {
  Cells cells = cells_on("builtin:animal", 3000);
  cells.stretch = 2;
  const CellSpace space(cells);
  for (const SparseMatrix& k :
       {*space.stiffness(), space.stiffness(varying(space)), space.stiffness(tensors(space, 2, 1))}) {
    EXPECT_EQ(asymmetry(k), 0);
    const Vector flow = k * Vector(Vector::Constant(space.unknowns(), 3));
    EXPECT_LT(flow.cwiseAbs().maxCoeff(), 1e-12);
    for (const double x : diagonal(k)) EXPECT_GT(x, 0);
    for (std::size_t e = 0; e < k.value.size(); ++e)
      EXPECT_TRUE(k.value[e] <= 0 || k.value[e] >= 1e-3);  // none but the diagonal is positive
  }
  double area = 0;
  for (const double a : diagonal(*space.sampled(SampleRule::vertices).mass)) area += a;
  EXPECT_NEAR(area, 5.362, 0.0536);
}

/// No flow within of a linear function; its slope everywhere.
TEST(CellSpace, IsExactForLinearFunctionsOnAPlane) {
  Cells cells = make_cells(shared(square_with_t_junctions()), 900);
  cells.stretch = 2;
  const CellSpace space(cells);
  const Vector u = values(space, [](const Point& p) { return 2 * p[0] - p[1]; });
  std::vector<Tensor> oblique(cells.nodes(), Tensor{2.5, 1.5, 0, 2.5, 0, 0});  // 4 along (1, 1), 1 across
  for (const Vector& flow : {*space.stiffness() * u, space.stiffness(oblique) * u})
    for (Eigen::Index i = 0; i < flow.size(); ++i) {
      const Point& p = cells.points[static_cast<std::size_t>(i)];
      const bool inside = std::min({p[0], 2 - p[0], p[1], 1 - p[1]}) > 2 * cells.radius;
      EXPECT_TRUE(!inside || std::abs(flow[i]) < 1e-12) << flow[i];
    }
  const Vector square = space.gradient_product(SampleRule::vertices, u, u);
  int wrong = 0;  // cells in corners may have a single neighbour
  for (const double x : square) wrong += std::abs(x - 5) > 1e-9;
  EXPECT_LE(wrong, 4);
  // The energy of all: area times u' T u, less what the border lacks.
  EXPECT_NEAR(dot(u, *space.stiffness() * u) / 10, 1, 0.02);
  EXPECT_NEAR(dot(u, space.stiffness(oblique) * u) / (2 * (2.5 * 5 - 2 * 1.5 * 2)), 1, 0.06);
}

/// Nothing flows into what does not diffuse.
TEST(CellSpace, LeavesOutWhatDoesNotDiffuse) {
  const CellSpace space(cells_on("builtin:sphere?n=2000", 500));
  std::vector<double> c;
  for (const Point& p : space.control()) c.push_back(p[2] > 0 ? 1 : 0);
  const Vector flow = space.stiffness(c) * values(space, [](const Point& p) { return p[2] > 0 ? 1.0 : 0.0; });
  EXPECT_LT(flow.cwiseAbs().maxCoeff(), 1e-12);
}

/// Largest relative error of the eigenvalues l (l + 1) of the unit sphere, l = 1, 2, by inverse iteration.
double spectral_error(const CellSpace& space) {
  constexpr int count = 9;
  const SparseMatrix &mass = *space.sampled(SampleRule::vertices).mass, &k = *space.stiffness();
  SparseMatrix shifted;
  combine(1, k, 1, mass, shifted);
  Eigen::MatrixXd basis(space.unknowns(), count);
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    const auto [x, y, z] = space.control()[static_cast<std::size_t>(i)];
    basis.row(i) << 1, x, y, z, x * y, y * z, z * x, x * x - y * y, 2 * z * z - x * x - y * y;
  }
  Vector eigenvalues;
  for (int iteration = 0; iteration < 3; ++iteration) {
    Eigen::MatrixXd m = basis, s = basis;
    for (int c = 0; c < count; ++c) {
      basis.col(c) = solve_spd(shifted, mass * Vector(basis.col(c)), {.tolerance = 1e-10});
      m.col(c) = mass * Vector(basis.col(c));
      s.col(c) = k * Vector(basis.col(c));
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(basis.transpose() * s, basis.transpose() * m);
    eigenvalues = ritz.eigenvalues();
    basis *= ritz.eigenvectors();
  }
  double worst = 0;
  for (int i = 1; i < count; ++i) worst = std::max(worst, std::abs(eigenvalues[i] / (i < 4 ? 2 : 6) - 1));
  return worst;
}

TEST(CellSpace, HasTheSphereAsItsSpectrum) {
  const double coarse = spectral_error(CellSpace(cells_on("builtin:sphere?n=80000", 1000)));
  const double fine = spectral_error(CellSpace(cells_on("builtin:sphere?n=80000", 4000)));
  RecordProperty("coarse", std::to_string(coarse));
  RecordProperty("fine", std::to_string(fine));
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, 0.4 * coarse);  // of the second order it is a quarter
}

/// Waves along and across decay at rates of their own: k^2 a^2.
TEST(CellSpace, DiffusesFasterAlongDirections) {
  TriangleMesh plane;
  add_square(plane, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8);
  Cells cells = make_cells(shared(plane), 3000);
  cells.stretch = 2;
  const CellSpace space(cells);
  const SparseMatrix k = space.stiffness(std::vector<Tensor>(cells.nodes(), Tensor{4, 0, 0, 1, 0, 0}));
  const SparseMatrix& mass = *space.sampled(SampleRule::vertices).mass;
  const auto rate = [&](const Vector& u) { return dot(u, k * u) / dot(u, mass * u) / std::pow(4 * M_PI, 2); };
  EXPECT_NEAR(rate(values(space, [](const Point& p) { return std::cos(4 * M_PI * p[0]); })), 4, 0.12);
  EXPECT_NEAR(rate(values(space, [](const Point& p) { return std::cos(4 * M_PI * p[1]); })), 1, 0.03);
}

TEST(CellSpace, KnowsTheCurvatureOfASphere) {
  const CellSpace space(cells_on("builtin:sphere?n=20000", 1000));
  const PrincipalCurvatures k = space.geometry(SampleRule::vertices, true).curvature;
  double mean = 0;
  for (std::size_t i = 0; i < k.k1.size(); ++i) mean += (k.k1[i] + k.k2[i]) / 2 / static_cast<double>(k.k1.size());
  EXPECT_NEAR(mean, 1, 0.03);
}

/// As in the print: the coefficients of a cell sum to 4; in the mean they make up the Laplacian.
TEST(TurkCells, HaveCoefficientsThatSumToFour) {
  const CellSpace space(cells_on("builtin:sphere?n=20000", 2000), CellSpace::Coefficients::turk);
  const SparseMatrix& mass = *space.sampled(SampleRule::vertices).mass;
  const Vector sums = diagonal(*space.stiffness());
  for (const double x : sums) EXPECT_NEAR(x / sums[0], 1, 1e-12);
  EXPECT_NEAR(sums[0], 4 * std::sqrt(3.0) / 2, 0.5);  // of even cells
  const Vector z = values(space, [](const Point& p) { return p[2]; });
  EXPECT_NEAR(dot(z, *space.stiffness() * z) / dot(z, mass * z) / 2, 1, 0.05);
  EXPECT_GT(asymmetry(*space.stiffness()), 1e-3);
}

TEST(CellSpace, EvaluatesOnTheTrianglesOfTheShape) {
  const CellSpace space(cells_on("builtin:sphere?n=2000", 2000));
  const ElementPoint p = space.element_point(7, 0.25, 0.5);
  EXPECT_NEAR(p.jet.row(0).sum(), 1, 1e-12);
  EXPECT_NEAR(p.jet.row(1).sum(), 0, 1e-12);
}

}  // namespace
}  // namespace pelage
