// Exponential steps on the spaces of runs, against the stabilised explicit ones on the same elements.

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "catalog/plan.h"
#include "catalog/shapes.h"
#include "run/run.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

Growth grown(const ShapeFile& shape, const std::string& stage) {
  ShapeFile copy = shape;
  const Plan planned = plan(parse_recipe("[stage]\n" + stage, "r.toml"));
  Growth run(bind_plan(planned, copy));
  while (!run.done()) run.advance(100);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  return run;
}

/// Both invert the mass by one term of its series, so that they solve the same equations.
TEST(EtdGrowth, GrowsWhatRkc2GrowsOnEverySpace) {
  const std::string model = "model = \"schnakenberg\"\nuntil = 1\nstep = 0.01\n";
  for (const auto& [shape, more] :
       {std::pair{"builtin:sphere?n=642", "size = \"0.8u\"\n"}, std::pair{"builtin:cube-sphere", "size = \"0.8u\"\n"},
        std::pair{"builtin:sphere?n=642", "size = \"0.8u\"\nmethod = \"cells\"\n"},
        std::pair{"builtin:sphere?n=642", "size = \"1u\"\nmethod = \"tets\"\n"},
        std::pair{"builtin:horseshoe?n=40x15", "size = 0.2\n"}}) {
    const ShapeFile file = find_shape(shape);
    const Growth series = grown(file, model + more + "stepper = \"etd\"\n"),
                 stages = grown(file, model + more + "stepper = \"rkc2\"\n");
    for (std::size_t i : {0, 1}) {
      const Vector &u = series.coefficients()[i], &v = stages.coefficients()[i];
      const Vector deviation = v.array() - v.mean();
      EXPECT_GT(deviation.norm(), 1e-3 * v.norm()) << shape << more;
      EXPECT_LT((u - v).norm(), 0.01 * deviation.norm()) << shape << more;
    }
  }
}

}  // namespace
}  // namespace pelage
