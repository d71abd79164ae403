#include "discretise/sampling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shape/generators.h"
#include "support/discretisations.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using testing::dense;

struct Surface {
  explicit Surface(const std::string& spec, const std::string& method = "loop")
      : control(builtin_shape(spec).points),
        discretisation(make_discretisation(method, make_topology(control.size(), builtin_shape(spec).triangles))),
        assembler(discretisation),
        mass(assembler.mass(control)) {}

  std::vector<Point> control;
  Discretisation discretisation;
  Assembler assembler;
  SparseMatrix mass;
};

double area(const Surface& s) {
  double sum = 0;
  for (double w : quadrature_geometry(s.discretisation, s.control).weight) sum += w;
  return sum;
}

const std::vector<std::string> shapes = {"builtin:sphere?n=642", "builtin:plane?n=200", "builtin:animal?n=1000",
                                         "builtin:cube?n=300"};

TEST(VertexSampling, WeightsArePositiveAndSumToTheArea) {
  for (const std::string& spec : shapes)
    for (const char* method : {"loop", "linear"}) {
      const Surface s(spec, method);
      const Sampling sampling = vertex_sampling(s.discretisation, s.control, s.mass);
      EXPECT_GT(sampling.weight.minCoeff(), 0) << spec;
      EXPECT_NEAR(sampling.weight.sum() / area(s), 1, 1e-12) << spec;
    }
}

/// Without clipped weights the quadrature at the vertices is exact for every basis function.
TEST(VertexSampling, IntegratesEveryBasisFunctionOfAnEvenMesh) {
  const Surface s("builtin:sphere?n=642");
  const Sampling sampling = vertex_sampling(s.discretisation, s.control, s.mass);
  const Vector exact = s.mass * Vector(Vector::Ones(s.discretisation.unknowns));
  const Vector sum = load(sampling, Vector::Ones(sampling.count()));
  EXPECT_LT((sum - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.maxCoeff());
}

TEST(Sampling, SampledMassIsTheProduct) {
  for (const char* spec : {"builtin:plane?n=200", "builtin:cube?n=300"}) {
    const Surface s(spec);
    for (const Sampling& sampling :
         {vertex_sampling(s.discretisation, s.control, s.mass), quadrature_sampling(s.discretisation, s.control)}) {
      const Eigen::MatrixXd a = dense(sampling.values);
      EXPECT_EQ(dense(sampling.test), Eigen::MatrixXd(a.transpose()));
      const Eigen::MatrixXd expected = a.transpose() * sampling.weight.asDiagonal() * a;
      const Eigen::MatrixXd mass = dense(sampled_mass(sampling, sampling.weight, s.mass.pattern));
      EXPECT_LT((mass - expected).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

/// At the quadrature points it is the mass matrix itself.
TEST(QuadratureSampling, HasTheConsistentMass) {
  const Surface s("builtin:cube?n=300");
  const Sampling sampling = quadrature_sampling(s.discretisation, s.control);
  EXPECT_LT((dense(sampled_mass(sampling, sampling.weight, s.mass.pattern)) - dense(s.mass)).cwiseAbs().maxCoeff(),
            1e-15);
  EXPECT_NEAR(sampling.weight.sum(), area(s), 1e-12);
}

TEST(Sampling, CoefficientsReproduceTheSamples) {
  for (const std::string& spec : shapes) {
    const Surface s(spec);
    const Sampling sampling = vertex_sampling(s.discretisation, s.control, s.mass);
    const SparseMatrix mass = sampled_mass(sampling, sampling.weight, s.mass.pattern);
    const Vector samples = testing::random_vector(sampling.count(), 5);
    const Vector again = sampling.values * coefficients_from_samples(sampling, mass, samples);
    EXPECT_LT((again - samples).cwiseAbs().maxCoeff(), 1e-8) << spec;
  }
}

TEST(InterpolatingControl, PutsTheLimitOnThePoints) {
  for (const std::string& spec : shapes) {
    const Surface s(spec);
    const std::vector<Point> control = interpolating_control(s.discretisation, s.control);
    const std::vector<Point> limit = limit_positions(s.discretisation, control);
    for (std::size_t i = 0; i < limit.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(limit[i][k], s.control[i][k], 1e-10) << spec;
  }
}

TEST(LimitNormals, OfASphereAreItsPlaces) {
  for (const char* method : {"loop", "linear"}) {
    const Surface s("builtin:sphere?n=642", method);
    const auto place = limit_positions(s.discretisation, s.control),
               normal = limit_normals(s.discretisation, s.control);
    for (std::size_t i = 0; i < place.size(); ++i) {
      const double radius = std::hypot(place[i][0], place[i][1], place[i][2]);
      EXPECT_NEAR(std::hypot(normal[i][0], normal[i][1], normal[i][2]), 1, 1e-14);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(normal[i][k], place[i][k] / radius, 1e-2);
    }
  }
}

}  // namespace
}  // namespace pelage
