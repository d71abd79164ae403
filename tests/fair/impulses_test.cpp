#include "fair/impulses.h"

#include <gtest/gtest.h>

#include "fair/compare.h"
#include "fair/noisy.h"

namespace pelage {
namespace {

struct Sparse {
  TriangleMesh noisy;
  std::vector<char> loud;  ///< per vertex
};

Sparse with_impulses(const TriangleMesh& truth, double sigma, double share) {
  Sparse result{testing::with_noise(truth, sigma), std::vector<char>(truth.points.size(), 1)};
  for (std::size_t v = 0; v < truth.points.size(); ++v) {
    if (uniform(7, v) < share) continue;
    result.noisy.points[v] = truth.points[v];
    result.loud[v] = 0;
  }
  return result;
}

TEST(Impulses, TwoNormalsOfAMixtureAreThoseThatItWasMadeOf) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < 20000; ++i)
    values.push_back((uniform(1, i) < 0.7 ? 0.1 : 0.8) * testing::gaussian(2, i));
  const TwoNormals m = fit_two_normals(values);
  EXPECT_NEAR(m.quiet, 0.1, 0.003);
  EXPECT_NEAR(m.loud, 0.8, 0.02);
  EXPECT_NEAR(m.share, 0.7, 0.01);
}

TEST(Impulses, OnAFlatAndOnARoundShapeLeaveTheOtherVerticesWhereTheyAre) {
  for (const auto& [shape, degrees] :
       {std::pair{"builtin:cube?n=3000", 1.5}, std::pair{"builtin:sphere?n=2562", 1.5}}) {
    const TriangleMesh truth = builtin_shape(shape);
    const Sparse sparse = with_impulses(truth, 0.5, 0.5);
    const Faired result = fair(sparse.noisy);
    std::size_t quiet = 0, stayed = 0;
    for (std::size_t v = 0; v < truth.points.size(); ++v) {
      quiet += !sparse.loud[v];
      stayed += !sparse.loud[v] && result.mesh.points[v] == truth.points[v];
    }
    EXPECT_GT(static_cast<double>(stayed), 0.85 * static_cast<double>(quiet)) << shape;
    EXPECT_GE(result.report.kept, stayed) << shape;
    const NormalErrors e = *compare(result.mesh, truth).normals;
    EXPECT_LT(e.mean, degrees) << shape;
    EXPECT_EQ(e.flipped, 0U) << shape;
  }
}

/// Neither noise on all vertices, nor details of a coarse shape that look like rare noise, nor nothing at all.
TEST(Impulses, AreNotFoundWhereThereAreNone) {
  for (const auto& [shape, sigma] : {std::pair{"builtin:cube?n=3000", 0.3}, std::pair{"builtin:cube?n=3000", 0.02},
                                     std::pair{"builtin:sphere?n=2562", 0.1}, std::pair{"builtin:animal?n=2000", 0.03},
                                     std::pair{"builtin:animal?n=2000", 0.3}, std::pair{"builtin:cube?n=600", 0.0}}) {
    EXPECT_EQ(fair(testing::with_noise(builtin_shape(shape), sigma)).report.kept, 0U) << shape << " " << sigma;
  }
}

TEST(Impulses, AStateGoesOnWithTheSameBits) {
  const TriangleMesh noisy = with_impulses(builtin_shape("builtin:sphere?n=642"), 0.5, 0.5).noisy;
  Fairing whole(noisy);
  while (!whole.done()) whole.step();
  Fairing second(noisy);
  second.restore(whole.state());
  EXPECT_GT(second.report().kept, 0U);
  EXPECT_EQ(second.points(), whole.points());
}

}  // namespace
}  // namespace pelage
