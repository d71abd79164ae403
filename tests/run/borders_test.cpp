// Conditions at the sides of grids, against solutions that are known.

#include "run/borders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "catalog/bind.h"
#include "catalog/models.h"
#include "catalog/plan.h"
#include "run/run.h"
#include "shape/generators.h"
#include "solid/fill.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

/// A solution of u_t = lap u + rate, in world units and model time, with the parts that conditions need.
struct Exact {
  std::string start, u, rate;
  std::vector<std::pair<std::string, std::string>> slope;  ///< n . grad u by the names of sides
  std::function<double(const Point&, double)> value;
};

/// A length unit of the world is two of the model.
constexpr double length_unit = 2, diffusion = 1 / (length_unit * length_unit);

enum class Kind { value, flux, exchange };

BorderCondition condition(const Exact& exact, const std::string& side, const std::string& slope, Kind kind) {
  BorderCondition c{side, {}, 0, {}, {}, {}};
  const auto formula = [](const std::string& text) { return BorderFormula(Formula{text, {}}, {{"two", 2}}); };
  const std::string flux = "(" + slope + ")/two";  // D times the length unit
  if (kind == Kind::value) c.value = formula(exact.u);
  if (kind == Kind::flux) c.flux = formula(flux);
  if (kind == Kind::exchange) {
    c.loss = formula("0.7 + t");
    c.flux = formula(flux + " + (0.7 + t)*(" + exact.u + ")");
  }
  return c;
}

/// At the time 0.1: the root of the integral of its square, and the largest at any node.
struct ErrorNorms {
  double mean = 0, largest = 0;
};

ErrorNorms error_on(const NodeShape& nodes, const Exact& exact, Kind kind, const StepperKind& stepper) {
  const Method& method = std::holds_alternative<TetMesh>(nodes) ? tets_method : grid_method;
  Program program;
  program.method = &method;
  StageProgram& stage = program.stages.emplace_back();
  stage.model =
      compile(parse_model("name = \"exact\"\nwavelength = 1\n[species.u]\ndiffusion = 0.25\nrate = \"" + exact.rate +
                              "\"\ninitial = \"" + exact.start + "\"\n[suggested]\nstep = 0.0005\n",
                          "exact.toml"));
  stage.stepper = &stepper;
  stage.length_unit = stage.size = length_unit;
  stage.step = stage.suggested_step = 0.0005;
  stage.until = 0.1;
  for (const auto& [side, slope] : exact.slope) stage.borders.push_back(condition(exact, side, slope, kind));
  Growth run(std::make_shared<const Program>(std::move(program)), World(method.make_node_space(nodes)));
  run.advance(1000);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  EXPECT_NEAR(run.summary().time, 0.1, 1e-9);
  Vector error(run.space().unknowns());
  for (Index v = 0; v < run.space().unknowns(); ++v)
    error[v] = run.coefficients()[0][v] - exact.value(run.space().control()[static_cast<std::size_t>(v)], 0.1);
  return {std::sqrt(error.dot(*run.system().mass * error)), error.cwiseAbs().maxCoeff()};
}

void expect_second_order(const std::function<NodeShape(std::int32_t)>& grid, std::int32_t n, const Exact& exact,
                         double largest, const StepperKind& stepper = sbdf2, double order_of_largest = 1.9) {
  for (const Kind kind : {Kind::value, Kind::flux, Kind::exchange}) {
    const ErrorNorms coarse = error_on(grid(n), exact, kind, stepper),
                     fine = error_on(grid(2 * n), exact, kind, stepper);
    const std::string which =
        exact.slope[0].first + " " + std::string(stepper.name) + " " + std::to_string(static_cast<int>(kind));
    EXPECT_LT(fine.mean, largest) << which;
    EXPECT_GE(std::log2(coarse.mean / fine.mean), 1.9) << which << ": " << coarse.mean << " " << fine.mean;
    EXPECT_GE(std::log2(coarse.largest / fine.largest), order_of_largest)
        << which << ": " << coarse.largest << " " << fine.largest;
  }
}

const Exact in_plane = {"(sin(3*x + 0.5)*cos(2*y) + x*x)",
                        "exp(-t)*(sin(3*x + 0.5)*cos(2*y) + x*x)",
                        "exp(-t)*(12*sin(3*x + 0.5)*cos(2*y) - x*x - 2)",
                        {{"xmin", "-exp(-t)*(3*cos(3*x + 0.5)*cos(2*y) + 2*x)"},
                         {"xmax", "exp(-t)*(3*cos(3*x + 0.5)*cos(2*y) + 2*x)"},
                         {"ymin", "exp(-t)*sin(3*x + 0.5)*2*sin(2*y)"},
                         {"ymax", "-exp(-t)*sin(3*x + 0.5)*2*sin(2*y)"}},
                        [](const Point& p, double t) {
                          return std::exp(-t) * (std::sin(3 * p[0] + 0.5) * std::cos(2 * p[1]) + p[0] * p[0]);
                        }};

Grid square(std::int32_t n, bool bent) {
  Grid g;
  g.count = {n + 1, n + 1, 1};
  g.spacing = {1.0 / n, 1.0 / n, 1};
  g.origin = {0.2, 0.3, 0};
  if (!bent) return g;
  std::vector<Point> points;
  for (std::int32_t v = 0; v < (n + 1) * (n + 1); ++v) {
    Point p = g.point(v);
    const double x = p[0] - 0.2, y = p[1] - 0.3;
    p[0] += 0.4 * x * (1 - x) * (y - 0.3);  // the sides stay where they are
    p[1] += 0.3 * y * (1 - y) * (x + 0.2);
    points.push_back(p);
  }
  g.points = std::move(points);
  return g;
}

TEST(Borders, ConditionsAreOfSecondOrderOnEvenSheets) {
  expect_second_order([](std::int32_t n) { return square(n, false); }, 8, in_plane, 1e-3);
}

TEST(Borders, ConditionsAreOfSecondOrderOnDistortedSheets) {
  expect_second_order([](std::int32_t n) { return square(n, true); }, 12, in_plane, 1e-3);
}

TEST(Borders, StabilisedExplicitStepsKeepTheOrder) {
  expect_second_order([](std::int32_t n) { return square(n, false); }, 8, in_plane, 1e-3, rkc2);
  expect_second_order([](std::int32_t n) { return square(n, true); }, 12, in_plane, 1e-3, rkc2);
}

/// Through the other sides passes nothing, so the solution has no slope there.
TEST(Borders, EverySideAloneKeepsTheOrder) {
  const std::string pi = "3.141592653589793";
  const auto quarter = [&](const std::string& distance) { return "cos(" + pi + "/4*" + distance + ")"; };
  for (const auto& [name, far, other] :
       {std::array{"xmin", "(1.2 - x)", "(y - 0.3)"}, std::array{"xmax", "(x - 0.2)", "(y - 0.3)"},
        std::array{"ymin", "(1.3 - y)", "(x - 0.2)"}, std::array{"ymax", "(y - 0.3)", "(x - 0.2)"}}) {
    // far: the distance from the side opposite, where the slope is 0.
    const std::string wave = quarter(far) + "*cos(" + pi + "*" + std::string(other) + ")";
    const double k2 = 17 * M_PI * M_PI / 16;
    const bool along_x = name[0] == 'x', upper = std::string(name).ends_with("max");
    const Exact exact = {wave,
                         "exp(-t)*" + wave,
                         "exp(-t)*" + std::to_string(k2 - 1) + "*" + wave,
                         {{name, "-exp(-t)*" + pi + "/4*sin(" + pi + "/4*" + far + ")*cos(" + pi + "*" + other + ")"}},
                         [=](const Point& p, double t) {
                           const double a =
                               along_x ? (upper ? p[0] - 0.2 : 1.2 - p[0]) : (upper ? p[1] - 0.3 : 1.3 - p[1]);
                           const double b = along_x ? p[1] - 0.3 : p[0] - 0.2;
                           return std::exp(-t) * std::cos(M_PI / 4 * a) * std::cos(M_PI * b);
                         }};
    for (const StepperKind* stepper : {&sbdf2, &rkc2})
      expect_second_order([](std::int32_t n) { return square(n, true); }, 20, exact, 1e-3, *stepper);
  }
}

TEST(Borders, OtherSteppersHeedThem) {
  for (const Kind kind : {Kind::value, Kind::flux, Kind::exchange}) {
    const double error = error_on(square(8, true), in_plane, kind, sbdf2).mean;
    for (const StepperKind* stepper : {&rkc2, &explicit_euler, &semi_implicit, &etd})
      if (kind != Kind::value || stepper->gives_values) {
        EXPECT_NEAR(error_on(square(8, true), in_plane, kind, *stepper).mean, error, 0.2 * error) << stepper->name;
      }
  }
}

TEST(Borders, ConditionsAreOfSecondOrderOnCurvedSheets) {
  const Exact exact = {"(x*cos(z) + z*z)",
                       "exp(-t)*(x*cos(z) + z*z)",
                       "exp(-t)*(x*cos(z) - z*z - 2)",
                       {{"xmin", "exp(-t)*y*cos(z)"},
                        {"xmax", "-exp(-t)*y*cos(z)"},
                        {"ymin", "exp(-t)*(x*sin(z) - 2*z)"},
                        {"ymax", "-exp(-t)*(x*sin(z) - 2*z)"}},
                       [](const Point& p, double t) { return std::exp(-t) * (p[0] * std::cos(p[2]) + p[2] * p[2]); }};
  const auto cylinder = [](std::int32_t n) {
    Grid g;
    g.count = {n + 1, n + 1, 1};
    for (std::int32_t v = 0; v < (n + 1) * (n + 1); ++v) {
      const double phi = 0.2 + 1.2 * (v % (n + 1)) / n, z = static_cast<double>(v / (n + 1)) / n;
      g.points.push_back({std::cos(phi), std::sin(phi), 0.1 + z});
    }
    return g;
  };
  expect_second_order(cylinder, 16, exact, 1e-3);
}

TEST(Borders, ConditionsAreOfSecondOrderInBlocks) {
  const Exact exact = {"(sin(3*x + 0.5)*cos(2*y)*cos(z) + x*x)",
                       "exp(-t)*(sin(3*x + 0.5)*cos(2*y)*cos(z) + x*x)",
                       "exp(-t)*(13*sin(3*x + 0.5)*cos(2*y)*cos(z) - x*x - 2)",
                       {{"xmin", "-exp(-t)*(3*cos(3*x + 0.5)*cos(2*y)*cos(z) + 2*x)"},
                        {"xmax", "exp(-t)*(3*cos(3*x + 0.5)*cos(2*y)*cos(z) + 2*x)"},
                        {"ymin", "exp(-t)*sin(3*x + 0.5)*2*sin(2*y)*cos(z)"},
                        {"ymax", "-exp(-t)*sin(3*x + 0.5)*2*sin(2*y)*cos(z)"},
                        {"zmin", "exp(-t)*sin(3*x + 0.5)*cos(2*y)*sin(z)"},
                        {"zmax", "-exp(-t)*sin(3*x + 0.5)*cos(2*y)*sin(z)"}},
                       [](const Point& p, double t) {
                         return std::exp(-t) *
                                (std::sin(3 * p[0] + 0.5) * std::cos(2 * p[1]) * std::cos(p[2]) + p[0] * p[0]);
                       }};
  const auto block = [](std::int32_t n) {
    Grid g;
    g.count = {n + 1, n + 1, n + 1};
    const auto m = static_cast<double>(n);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(g.nodes()); ++v) {
      const double x = v % (n + 1) / m, y = v / (n + 1) % (n + 1) / m, z = v / (n + 1) / (n + 1) / m;
      g.points.push_back({0.2 + x + 0.3 * x * (1 - x) * (y - 0.4), 0.3 + y + 0.3 * y * (1 - y) * z, 0.1 + z});
    }
    return g;
  };
  expect_second_order(block, 8, exact, 5e-3);
}

TEST(Borders, ConditionsAreOfSecondOrderOnTheSkinOfABall) {
  const Exact exact = {"(sin(3*x + 0.5)*cos(2*y)*cos(z) + x*x)",
                       "exp(-t)*(sin(3*x + 0.5)*cos(2*y)*cos(z) + x*x)",
                       "exp(-t)*(13*sin(3*x + 0.5)*cos(2*y)*cos(z) - x*x - 2)",
                       {{"skin",
                         "exp(-t)*(x*(3*cos(3*x + 0.5)*cos(2*y)*cos(z) + 2*x) - y*sin(3*x + 0.5)*2*sin(2*y)*cos(z) - "
                         "z*sin(3*x + 0.5)*cos(2*y)*sin(z))"}},
                       [](const Point& p, double t) {
                         return std::exp(-t) *
                                (std::sin(3 * p[0] + 0.5) * std::cos(2 * p[1]) * std::cos(p[2]) + p[0] * p[0]);
                       }};
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=20000");
  const auto ball = [&](std::int32_t n) { return fill(sphere, 1.0 / n, 4'000'000).volume; };
  // The worst tetrahedra of two fillings differ.
  expect_second_order(ball, 5, exact, 3e-2, sbdf2, 1.8);
}

std::string fault_of(const std::string& boundary, bool periodic = false, const std::string& more = "") {
  Grid g = square(8, false);
  g.periodic = {periodic, periodic, false};
  try {
    make_program(parse_recipe("[stage]\nmodel = \"turing\"\nsize = \"4px\"\n" + more + "[stage.boundary]\n" + boundary,
                              "r.toml"),
                 g);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Borders, RecipesSayThemAndFaultsAreLocated) {
  EXPECT_EQ(fault_of("xmin = { a = { value = \"1 + 0.1*sin(t)\" }, b = { flux = \"0.1*y\", loss = 2 } }\n"), "");
  EXPECT_NE(fault_of("left = { a = { value = 1 } }\n").find("r.toml:5"), std::string::npos);
  EXPECT_NE(fault_of("left = { a = { value = 1 } }\n").find("xmin, xmax, ymin, ymax"), std::string::npos);
  EXPECT_NE(fault_of("xmin = { q = { value = 1 } }\n").find("r.toml:5"), std::string::npos);
  EXPECT_NE(fault_of("xmin = { a = { value = 1, flux = 2 } }\n").find("either a value, or"), std::string::npos);
  EXPECT_NE(fault_of("xmin = { a = { value = \"a\" } }\n").find("r.toml:5"), std::string::npos);
  EXPECT_NE(fault_of("xmin = { a = { valeu = 1 } }\n"), "");
  EXPECT_NE(fault_of("xmin = { a = { value = 1 } }\n", true).find("all its axes are periodic"), std::string::npos);
  EXPECT_NE(
      fault_of("xmin = { a = { value = 1 } }\n", false, "stepper = \"semi-implicit\"\n").find("cannot give values"),
      std::string::npos);
}

/// An inflow at one side of a species that nothing else changes is what the amount grows by.
TEST(Borders, WhatComesInStaysThere) {
  Grid g = square(10, true);
  Program program;
  program.method = &grid_method;
  StageProgram& stage = program.stages.emplace_back();
  stage.model =
      compile(parse_model("name = \"in\"\nwavelength = 1\n[species.u]\ndiffusion = 0.25\nrate = \"0\"\ninitial = "
                          "\"1\"\n[suggested]\nstep = 0.01\n",
                          "in.toml"));
  stage.length_unit = stage.size = length_unit;
  stage.step = stage.suggested_step = 0.01;
  stage.until = 1;
  BorderCondition& c = stage.borders.emplace_back(BorderCondition{"ymax", {}, 0, {}, {}, {}});
  c.flux.emplace(Formula{"3", {}}, std::map<std::string, double>{});
  Growth run(std::make_shared<const Program>(std::move(program)), World(grid_method.make_node_space(g)));
  run.advance(1000);
  EXPECT_NEAR(sum(*run.system().mass * run.coefficients()[0]), 1 + 3 * length_unit, 1e-9);
}

}  // namespace
}  // namespace pelage
