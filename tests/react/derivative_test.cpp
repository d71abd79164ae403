#include "react/derivative.h"

#include <cmath>

#include "react/linear_split.h"
#include "react/support.h"

namespace pelage {
namespace {

/// A text in the species u, and x, y.
struct Function {
  explicit Function(const std::string& text) {
    u = graph.symbol({Symbol::Kind::species, 0});
    Scope scope;
    scope.names["u"] = u;
    root = parse_formula(graph, {text, {}}, scope, "f");
  }
  double operator()(NodeId id, double at) const {
    const auto value = [&](const Symbol& s) { return s.kind == Symbol::Kind::species ? at : 0.7 + s.index; };
    return evaluate(graph, std::vector{id}, value).front();
  }
  Graph graph;
  NodeId u, root;
};

TEST(Derivative, AgreesWithCentralDifferences) {
  // Away from jumps and kinks of these functions.
  const double places[] = {0.37, 0.81, 1.43, 2.6};
  for (const char* text : {"u",
                           "3",
                           "x",
                           "u + x",
                           "x - u",
                           "u*x*u",
                           "u/x",
                           "x/u",
                           "-u^3",
                           "u^2.5",
                           "2^u",
                           "u^u",
                           "u^x",
                           "u^-2",
                           "min(u, 1)",
                           "max(u, 1)",
                           "min(x*u, u^2)",
                           "abs(u - 1)",
                           "abs(1 - u^2)",
                           "floor(u)",
                           "exp(-u*u)",
                           "log(u)",
                           "sqrt(1 + u)",
                           "sin(3*u)",
                           "cos(3*u)",
                           "tan(u/2)",
                           "tanh(2*u)",
                           "erf(u - x)",
                           "sinh(2*u)",
                           "cosh(u - 1)",
                           "log10(1 + u*u)",
                           "sign(u)*u",
                           "mod(u, x)",
                           "mod(3*x, u)",
                           "u < 1",
                           "u >= 1",
                           "not u",
                           "u and x",
                           "if(u < 1, u^2, 2*u)",
                           "step(1, u)*u",
                           "smoothstep(0, 2, u)",
                           "smoothstep(0, u, x)",
                           "clamp(u, 0.5, 1.5)",
                           "clamp(1, u, 2*u)",
                           "u^2*exp(-u)/(1 + u^2) - sin(u*x)^3",
                           "pow(1 + u^2, u*x)"}) {
    Function f(text);
    const NodeId df = derivative(f.graph, std::vector{f.root}, f.u).front();
    for (const double u : places) {
      const double h = 1e-5, difference = (f(f.root, u + h) - f(f.root, u - h)) / (2 * h);
      EXPECT_NEAR(f(df, u), difference, 1e-8 * (1 + std::fabs(difference))) << text << " at " << u;
    }
  }
}

TEST(Derivative, OfPowerExistsForNegativeBase) {
  Function f("u^3");
  EXPECT_EQ(f(derivative(f.graph, std::vector{f.root}, f.u).front(), -2), 12);
}

TEST(LinearSplit, RestoresTheRate) {
  for (const char* text : {"3*u + x", "u^2*x - u^3 + 2", "(u - x)^5/y", "sin(u)", "u/(1 + u)", "x", "u*exp(u)",
                           "-(u*(1 - u))", "if(u < 1, u, x)", "(u + x)*(u - y)*u"}) {
    Function f(text);
    const LinearSplit split = linear_split(f.graph, f.root, f.u);
    for (const double u : {-1.3, 0.4, 2.2}) {
      const double rate = f(f.root, u), terms = std::fabs(f(split.c2, u) * u) + std::fabs(f(split.c3, u)) + 1;
      EXPECT_NEAR(f(split.c2, u) * u + f(split.c3, u), rate, 50 * terms * 1e-16) << text;
    }
  }
}

TEST(LinearSplit, OfPolynomialHasConstantTermFreeOfTheSpecies) {
  Function f("u^2*x - u + 5 - (u - 1)^2");
  const LinearSplit split = linear_split(f.graph, f.root, f.u);
  EXPECT_EQ(f.graph[split.c3].dependence & on_species, 0u);
  EXPECT_EQ(f(split.c3, 99), 4);
  EXPECT_NEAR(f(split.c2, 3), 3 * 0.7 - 1 - 3 + 2, 1e-14);
}

TEST(LinearSplit, OtherwiseIsTheTangent) {
  Function f("exp(2*u)");
  const LinearSplit split = linear_split(f.graph, f.root, f.u);
  EXPECT_DOUBLE_EQ(f(split.c2, 0.5), 2 * std::exp(1.0));
}

}  // namespace
}  // namespace pelage
