#include <gtest/gtest.h>

#include <ostream>

#include "verify/figure.h"

namespace pelage {
namespace {

using Verification = std::vector<Figure> (*)();

struct Part {
  const char* name;
  Verification run;
};

void PrintTo(const Part& part, std::ostream* out) { *out << part.name; }

class Verify : public ::testing::TestWithParam<Part> {};

TEST_P(Verify, EveryFigureKeepsItsBound) {
  const std::vector<Figure> figures = GetParam().run();
  EXPECT_FALSE(figures.empty());
  for (const Figure& f : figures) {
    EXPECT_TRUE(f.passed()) << f.what << ": " << f.value << ", must be at " << (f.at_least ? "least " : "most ")
                            << f.bound;
  }
}

INSTANTIATE_TEST_SUITE_P(Figures, Verify,
                         ::testing::Values(Part{"basis", verify_basis}, Part{"matrices", verify_matrices},
                                           Part{"convergence", verify_convergence},
                                           Part{"eigenvalues", verify_eigenvalues},
                                           Part{"time_steppers", verify_time_steppers},
                                           Part{"early_growth", verify_early_growth}, Part{"size", verify_size}),
                         [](const auto& part) { return std::string(part.param.name); });

}  // namespace
}  // namespace pelage
