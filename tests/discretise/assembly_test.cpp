#include "discretise/assembly.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/dense.h"
#include "base/parallel.h"
#include "base/random.h"
#include "discretise/quadrature.h"
#include "shape/generators.h"
#include "support/discretisations.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using testing::dense;
using Vec = Eigen::Vector3d;

Discretisation discretise(const TriangleMesh& mesh, const std::string& method = "loop") {
  return make_discretisation(method, make_topology(mesh.points.size(), mesh.triangles));
}

Vec vec(const Point& p) { return Vec(p.data()); }

/// Tangents and gradients at every quadrature point, straight from the definitions: gradient = (tangent plane's
/// pseudo-inverse) times the derivatives by (v, w).
struct Dense {
  Eigen::MatrixXd mass, stiffness;
};

Dense dense_matrices(const Discretisation& d, const std::vector<Point>& control, const Eigen::Matrix3d& tensor) {
  Dense m{Eigen::MatrixXd::Zero(d.unknowns, d.unknowns), Eigen::MatrixXd::Zero(d.unknowns, d.unknowns)};
  for (std::size_t e = 0; e < d.elements(); ++e) {
    const ElementClass& c = d.classes[static_cast<std::size_t>(d.element_class[e])];
    const Index* function = d.function.data() + d.first_function[e];
    for (Index q = 0; q < c.points(); ++q) {
      Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
      for (Index i = 0; i < c.functions(); ++i) {
        tangents.col(0) += c.dv(q, i) * vec(control[static_cast<std::size_t>(function[i])]);
        tangents.col(1) += c.dw(q, i) * vec(control[static_cast<std::size_t>(function[i])]);
      }
      const Eigen::Matrix<double, 3, 2> dual = tangents * (tangents.transpose() * tangents).inverse();
      const double weight = c.weight[q] * Vec(tangents.col(0)).cross(Vec(tangents.col(1))).norm();
      for (Index i = 0; i < c.functions(); ++i)
        for (Index j = 0; j < c.functions(); ++j) {
          const Vec gi = dual * Eigen::Vector2d(c.dv(q, i), c.dw(q, i)),
                    gj = dual * Eigen::Vector2d(c.dv(q, j), c.dw(q, j));
          m.mass(function[i], function[j]) += weight * c.value(q, i) * c.value(q, j);
          m.stiffness(function[i], function[j]) += weight * gi.dot(tensor * gj);
        }
    }
  }
  return m;
}

double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

Tensor packed(const Eigen::Matrix3d& t) { return {t(0, 0), t(0, 1), t(0, 2), t(1, 1), t(1, 2), t(2, 2)}; }

std::vector<TriangleMesh> surfaces() {
  return {builtin_shape("builtin:sphere?n=162"), builtin_shape("builtin:plane?n=100"),
          builtin_shape("builtin:cube?n=150")};
}

TEST(Assembly, QuadratureIsExactForQuartics) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");  // elements with and without splits
  const Discretisation d = loop_discretisation(make_topology(mesh.points.size(), mesh.triangles));
  for (const ElementClass& c : d.classes)
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        double sum = 0;
        for (Index q = 0; q < c.points(); ++q) {
          const auto [v, w] = c.place[static_cast<std::size_t>(q)];
          sum += c.weight[q] * std::pow(v, i) * std::pow(w, j);
        }
        EXPECT_NEAR(sum, std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3), 1e-14) << i << " " << j;
      }
}

TEST(Assembly, AgreesWithThePlainDenseLoop) {
  for (const char* method : {"loop", "linear"})
    for (const TriangleMesh& mesh : surfaces()) {
      const Discretisation d = discretise(mesh, method);
      const Assembler assembler(d);
      const Dense expected = dense_matrices(d, mesh.points, Eigen::Matrix3d::Identity());
      EXPECT_LT(largest(dense(assembler.mass(mesh.points)) - expected.mass), 1e-14 * (1 + largest(expected.mass)));
      EXPECT_LT(largest(dense(assembler.stiffness(mesh.points)) - expected.stiffness),
                1e-12 * largest(expected.stiffness));
    }
}

/// The fast ways have the bits of the plain ones.
TEST(Assembly, BothMatricesAtOnceAreThoseOneByOne) {
  for (const char* method : {"loop", "linear"})
    for (const TriangleMesh& mesh : surfaces()) {
      const Discretisation d = discretise(mesh, method);
      const Assembler assembler(d);
      const AssembledMatrices both = assembler.mass_and_stiffness(mesh.points);
      EXPECT_EQ(both.mass.value, assembler.mass(mesh.points).value);
      EXPECT_EQ(both.stiffness.value, assembler.stiffness(mesh.points).value);
      double area = 0, expected = 0;
      for (const double a : both.area) area += a;
      for (const double w : quadrature_geometry(d, mesh.points).weight) expected += w;
      EXPECT_NEAR(area / expected, 1, 1e-13);
    }
}

TEST(Assembly, BasisProductsOfAnySizeHaveTheSameBits) {
  for (const auto& [points, functions] : {std::pair{6, 12}, {24, 11}, {24, 17}, {24, 64}, {3, 65}}) {
    const RowMatrix left = RowMatrix::Random(points, functions), right = RowMatrix::Random(points, functions);
    const auto size = static_cast<std::size_t>(functions * functions);
    std::vector<double> fast(size, 0.0), plain(size, 0.0);
    add_basis_product(left, right.data(), fast.data());
    add_basis_product_plain(left, right.data(), plain.data());
    EXPECT_EQ(fast, plain) << functions;
  }
}

TEST(Assembly, FactorsAreTakenAtTheirQuadraturePoint) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  const Discretisation d = discretise(mesh);
  const Assembler assembler(d);
  const QuadratureGeometry g = quadrature_geometry(d, mesh.points);
  std::vector<double> factor;
  for (const Point& p : g.position) factor.push_back(1.5 + p[0]);
  const Vector ones = Vector::Ones(d.unknowns);
  double integral = 0;
  for (std::size_t q = 0; q < factor.size(); ++q) integral += factor[q] * g.weight[q];
  EXPECT_NEAR(dot(ones, assembler.mass(mesh.points, factor) * ones), integral, 1e-12);
  // The isotropic tensor c 1 is the factor c.
  std::vector<Tensor> tensor;
  for (double c : factor) tensor.push_back({c, 0, 0, c, 0, c});
  const auto a = dense(assembler.stiffness(mesh.points, factor)), b = dense(assembler.stiffness(mesh.points, tensor));
  EXPECT_LT(largest(a - b), 1e-12 * largest(a));
}

/// The gradient of a linear function is constant on a flat patch, and Loop's functions reproduce linear functions
/// inside: c'Kc is the integral of |grad|^2 over the triangles away from the boundary. The irregular grading of the
/// control points does not matter, only that the map of limit points is the plane.
TEST(Assembly, LinearFunctionsOnAFlatPatch) {
  for (const char* method : {"loop", "linear"}) {
    TriangleMesh mesh = builtin_shape("builtin:plane?n=150");
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) mesh.points[i][k] += 0.02 * uniform(3 + k, i);
    const Discretisation d = discretise(mesh, method);
    Vector c(d.unknowns);
    for (Eigen::Index i = 0; i < c.size(); ++i) c[i] = 3 * mesh.points[i][0] - 2 * mesh.points[i][1] + 7;
    double area = 0;
    for (double w : quadrature_geometry(d, mesh.points).weight) area += w;
    EXPECT_NEAR(dot(c, Assembler(d).stiffness(mesh.points) * c) / (13 * area), 1, 1e-12) << method;
    for (const Point& g : quadrature_gradients(d, mesh.points, c)) {
      EXPECT_NEAR(g[0], 3, 1e-10);
      EXPECT_NEAR(g[1], -2, 1e-10);
    }
  }
}

TEST(Assembly, TensorStiffnessIsSymmetricAndSemidefinite) {
  const TriangleMesh mesh = builtin_shape("builtin:cube?n=150");
  const Discretisation d = discretise(mesh);
  Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vec(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d tensor = axes * Vec(100, 1, 10).asDiagonal() * axes.transpose();
  const std::vector<Tensor> everywhere(static_cast<std::size_t>(d.first_point.back()), packed(tensor));
  const Eigen::MatrixXd k = dense(Assembler(d).stiffness(mesh.points, everywhere));
  EXPECT_LT(largest(k - dense_matrices(d, mesh.points, tensor).stiffness), 1e-11 * largest(k));
  EXPECT_LT(largest(k - k.transpose()), 1e-12 * largest(k));
  EXPECT_LT(largest(k * Vector::Ones(d.unknowns)), 1e-11 * largest(k));
  const Vector eigenvalues = symmetric_modes(k).values;
  EXPECT_GT(eigenvalues[0], -1e-11 * eigenvalues[eigenvalues.size() - 1]);
  EXPECT_GT(eigenvalues[1], 1e-6);  // constants alone have no gradient
}

TEST(Assembly, RigidMotionsChangeNothing) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=500");
  TriangleMesh moved = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec(-1, 2, 0.5).normalized()).toRotationMatrix();
  for (Point& p : moved.points) Eigen::Map<Vec>(p.data()) = turn * vec(p) + Vec(3, -2, 5);
  const Discretisation d = discretise(mesh);
  const Assembler assembler(d);
  const auto m = dense(assembler.mass(mesh.points)), k = dense(assembler.stiffness(mesh.points));
  EXPECT_LT(largest(dense(assembler.mass(moved.points)) - m), 1e-12 * largest(m));
  EXPECT_LT(largest(dense(assembler.stiffness(moved.points)) - k), 1e-11 * largest(k));
}

/// Other numbers for vertices and triangles, and other first corners, permute the matrices.
TEST(Assembly, RenumberingPermutesTheMatrices) {
  const TriangleMesh mesh = builtin_shape("builtin:cube?n=150");
  const auto n = static_cast<Index>(mesh.points.size());
  auto renumbered = [&](Index v) { return static_cast<Index>((static_cast<std::int64_t>(v) * 101 + 17) % n); };
  ASSERT_EQ(std::gcd(n, 101), 1);
  TriangleMesh other = mesh;
  for (Index v = 0; v < n; ++v) other.points[renumbered(v)] = mesh.points[v];
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[mesh.triangles.size() - 1 - f];
    for (std::size_t k = 0; k < 3; ++k) other.triangles[f][k] = renumbered(t[(k + f) % 3]);
  }
  const Discretisation a = discretise(mesh), b = discretise(other);
  const auto k = dense(Assembler(a).stiffness(mesh.points)), k_other = dense(Assembler(b).stiffness(other.points));
  double worst = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) worst = std::max(worst, std::abs(k(i, j) - k_other(renumbered(i), renumbered(j))));
  EXPECT_LT(worst, 1e-12 * largest(k));
}

/// The linear method's stiffness is that of the cotangents of the angles opposite to each edge.
TEST(Assembly, LinearMethodHasCotangentWeights) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=500");
  const Discretisation d = discretise(mesh, "linear");
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(d.unknowns, d.unknowns);
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const Vec to_a = vec(mesh.points[a]) - vec(mesh.points[t[k]]),
                to_b = vec(mesh.points[b]) - vec(mesh.points[t[k]]);
      const double half_cotangent = to_a.dot(to_b) / to_a.cross(to_b).norm() / 2;
      expected(a, b) -= half_cotangent;
      expected(b, a) -= half_cotangent;
      expected(a, a) += half_cotangent;
      expected(b, b) += half_cotangent;
    }
  EXPECT_LT(largest(dense(Assembler(d).stiffness(mesh.points)) - expected), 1e-11 * largest(expected));
}

TEST(Assembly, SameBitsForAnyNumberOfThreads) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=3000");
  const Discretisation d = discretise(mesh);
  const Assembler several(d);
  const SparseMatrix mass = several.mass(mesh.points), stiffness = several.stiffness(mesh.points);
  const ThreadLimit limit(1);
  const Assembler one(d);
  EXPECT_EQ(one.pattern()->column, several.pattern()->column);
  EXPECT_EQ(one.mass(mesh.points).value, mass.value);
  EXPECT_EQ(one.stiffness(mesh.points).value, stiffness.value);
}

/// A flat disc of `n` triangles around vertex 0, with corners on the unit circle.
TriangleMesh fan(Index n) {
  TriangleMesh mesh;
  mesh.points.push_back({0, 0, 0});
  for (Index i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return mesh;
}

/// Every entry is known in closed form, with the relative error of the area of such a thin triangle.
TEST(Assembly, TheRowOfAHubHasNoLongestLength) {
  const Index n = 70'000;  // more entries than 16 bits can number
  const TriangleMesh mesh = fan(n);
  const Discretisation d = discretise(mesh, "linear");
  const Assembler assembler(d);
  const SparseMatrix mass = assembler.mass(mesh.points), stiffness = assembler.stiffness(mesh.points);
  const double angle = 2 * std::numbers::pi / n, area = std::sin(angle) / 2;
  const Vector ones = Vector::Ones(n + 1), share = mass * ones, zero = stiffness * ones;
  EXPECT_NEAR(share[0], n * area / 3, 1e-8);
  EXPECT_NEAR(zero.cwiseAbs().maxCoeff(), 0, 1e-6);  // entries of the rim are as large as 1e4
  for (Index i = 1; i <= n; ++i) {
    const auto entry = [&](const SparseMatrix& a, Index row, Index column) {
      return a.value[static_cast<std::size_t>(a.pattern->find(row, column))];
    };
    ASSERT_NEAR(share[i] / area, 2. / 3, 1e-6) << i;
    ASSERT_NEAR(entry(mass, 0, i) / area, 1. / 6, 1e-6) << i;
    ASSERT_EQ(entry(mass, 0, i), entry(mass, i, 0)) << i;
    ASSERT_NEAR(entry(stiffness, 0, i) / std::tan(angle / 2), -1, 1e-6) << i;
  }
}

}  // namespace
}  // namespace pelage
