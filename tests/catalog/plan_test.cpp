// Faults that need no shape are found without one; those that need one, before any work.

#include "catalog/plan.h"

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "look/dress.h"
#include "pelage/error.h"
#include "run/run.h"
#include "shape/generators.h"

namespace pelage {
namespace {

std::string fault_of_plan(const std::string& text) {
  try {
    plan(parse_recipe(text, "test.toml"));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string fault_of_bind(const std::string& text, const std::string& shape = "builtin:sphere?n=162") {
  const Plan planned = plan(parse_recipe(text, "test.toml"));
  try {
    bind_plan(planned, builtin_shape(shape));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string turing = "[stage]\nmodel = \"turing\"\nsize = 0.5\n";

TEST(Plan, FindsWhatNeedsNoShape) {
  const auto expect = [](const std::string& more, const std::string& what) {
    EXPECT_NE(fault_of_plan(turing + more).find(what), std::string::npos) << fault_of_plan(turing + more);
  };
  expect("mask = \"earlier.b\"\n", "test.toml:4:9: there is no field \"earlier.b\"");
  expect("initial = { b = \"q\" }\n", "unknown name \"q\"");
  expect("[look]\nramp = \"tawni\"\n", "test.toml:5");
  expect("[[look.layers]]\ncolor = \"#123456\"\nopacity = \"c\"\n", "test.toml:6:");
  expect("[look]\nroughness = \"b + c\"\n", "test.toml:5:18");
  expect("[look]\nheight = \"stage0.b\"\n", "test.toml:5:");
  expect("[[look.layers]]\ncolor = \"#123456\"\nopacity = \"t\"\n",
         "test.toml:6:12: this can depend on the place only");
  expect("[motion]\nfair = \"gided\"\n", "did you mean \"guided\"");
  EXPECT_EQ(fault_of_plan(turing + "size-map = \"1 + s*0.1*bx\"\n"), "");  // parameters are known there, too
}

/// A solver asks for a stepper that solves.
TEST(Plan, SolversBelongToImplicitSteppers) {
  EXPECT_EQ(plan(parse_recipe(turing, "t")).stages[0].stepper, &rkc2);
  const Plan planned = plan(parse_recipe(turing + "solver = \"red-black\"\n", "t"));
  EXPECT_EQ(planned.stages[0].stepper, &sbdf2);
  EXPECT_EQ(planned.stages[0].solver, &coloured_sweeps);
  const auto expect = [](const std::string& more, const std::string& what) {
    EXPECT_NE(fault_of_plan(turing + more).find(what), std::string::npos) << fault_of_plan(turing + more);
  };
  expect("solver = \"red\"\n", "test.toml:4:10: unknown solver \"red\"");
  for (const std::string stepper : {"rkc2", "etd", "gaussian", "binary"})
    expect("stepper = \"" + stepper + "\"\nsolver = \"sor\"\n", "it solves no linear systems");
  for (const std::string stepper : {"sbdf2", "semi-implicit", "explicit", "sign-iteration"})
    EXPECT_EQ(fault_of_plan(turing + "stepper = \"" + stepper + "\"\nsolver = \"sor\"\n"), "");
  EXPECT_NE(
      fault_of_plan("[stage]\nmodel = \"swift-hohenberg\"\nsize = 0.5\nsolver = \"cg\"\n").find("coupled by lap()"),
      std::string::npos);
}

TEST(Plan, MatricesAreKeptByTheStepperThatMakesThemOfTheFields) {
  EXPECT_EQ(plan(parse_recipe(turing + "refresh = 4\n", "t")).stages[0].stepper, &semi_implicit);
  EXPECT_NE(fault_of_plan(turing + "stepper = \"sbdf2\"\nrefresh = 4\n").find("keep its matrices for some steps"),
            std::string::npos);
}

TEST(Bind, FindsWhatNeedsTheShape) {
  EXPECT_EQ(fault_of_bind(turing), "");
  EXPECT_NE(
      fault_of_bind(turing + "mask = \"attribute(age)\"\n").find("test.toml:4:9: the mesh has no vertex attribute"),
      std::string::npos);
  EXPECT_NE(fault_of_bind(turing + "[[look.layers]]\ncolor = \"#123456\"\nopacity = \"attribute(age)\"\n")
                .find("test.toml:6:12: the mesh has no vertex attribute"),
            std::string::npos);
  EXPECT_NE(fault_of_bind(turing + "size-map = \"bx\"\n").find("test.toml:4:13: the map of the size is"),
            std::string::npos);
}

/// They used to be accepted, and to fail after the whole run.
TEST(Bind, LayersReadCurvaturesAndNormals) {
  const Recipe recipe = parse_recipe(turing +
                                         "steps = 2\n[look]\ndetail = 1\n[[look.layers]]\ncolor = \"#000000\"\n"
                                         "[[look.layers]]\ncolor = \"#ffffff\"\nopacity = \"0.1*k1*k2 + 0.1*H*nx^2 + "
                                         "0.1*H*ny^2 + 0.1*H*nz^2\"\n",
                                     "test.toml");
  for (const bool flat : {false, true})
    for (const char* method : {"loop", "linear"}) {
      Recipe r = recipe;
      r.look.flat = flat;
      r.stages[0].method.value = method;
      pelage::Run run(make_program(r, builtin_shape("builtin:sphere?n=642")));
      run.advance(10);
      const TriangleMesh coat = dress(run.fields(), r.look);
      double sum = 0;
      for (const double c : coat.find("color")->values) sum += c;
      const double mean = sum / static_cast<double>(coat.find("color")->values.size());
      EXPECT_NEAR(mean, 0.2, 0.02) << method;  // k1 = k2 = H = 1 on the unit sphere
    }
}

TEST(Bind, VerticesOfVeryHighValenceGetLinearElements) {
  TriangleMesh fan;
  fan.points = {{0, 0, 1}};
  const int n = 250;
  for (int i = 0; i < n; ++i) fan.points.push_back({std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), 0});
  for (int i = 0; i < n; ++i) fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  const Program fitted = make_program({}, fan);
  EXPECT_EQ(fitted.method, &linear_method);
  ASSERT_EQ(fitted.warnings.size(), 1U);
  EXPECT_NE(fitted.warnings[0].find("a vertex has 250 edges"), std::string::npos);
  Recipe insists;
  insists.stages[0].method = {"loop", {"--method"}};
  EXPECT_EQ(make_program(insists, fan).method, &loop_method);
}

TEST(Bind, MethodsForGridsTakeNoMeshes) {
  Recipe recipe;
  recipe.stages[0].method = {"grid", {"--method"}};
  EXPECT_THROW(make_program(recipe, builtin_shape("builtin:sphere?n=162")), Error);
}

}  // namespace
}  // namespace pelage
