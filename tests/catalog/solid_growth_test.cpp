// Coats in the volume of closed surfaces: what a recipe says, and wavelengths against theory.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "catalog/bind.h"
#include "pelage/grow.h"
#include "run/run.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using SolidRun = Run;  // in a test, Run is a function of its own
using std::numbers::pi;

Recipe recipe(const std::string& text) { return parse_recipe(text, "solid.toml"); }

std::string fault_of(const std::string& text, const TriangleMesh& shape) {
  try {
    make_program(recipe(text), shape);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(SolidGrowth, RecipesSayIt) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=500");
  const std::string stage = "[stage]\nmodel = \"turing\"\nsize = 0.3\n";
  const Program program = make_program(recipe("solid = true\n" + stage), sphere);
  ASSERT_TRUE(as<TetMesh>(program.nodes));
  EXPECT_EQ(program.method, &tets_method);
  EXPECT_EQ(program.shape->points.size(), as<TetMesh>(program.nodes)->nodes());
  EXPECT_FALSE(make_program(recipe("solid = false\n" + stage), sphere).nodes);
  EXPECT_EQ(fault_of("solid = true\n" + stage + "[stage.boundary]\nskin = { a = { value = 4 } }\n", sphere), "nothing");
  EXPECT_NE(
      fault_of("solid = true\n" + stage + "[stage.boundary]\nxmin = { a = { value = 4 } }\n", sphere).find("skin"),
      std::string::npos);
  EXPECT_NE(fault_of("solid = true\n" + stage + "method = \"loop\"\n", sphere).find("solid.toml:5"), std::string::npos);
  TriangleMesh open = sphere;
  open.triangles.pop_back();
  EXPECT_NE(fault_of("solid = true\n" + stage, open).find("3 edges with one face only"), std::string::npos);
}

/// 2 pi over the root of the mean square of the wave number, which is that of u.
double wavelength(const SolidRun& run, std::size_t species) {
  Vector u = run.coefficients()[species];
  const SampledMass sampled = run.space().sampled(SampleRule::vertices);
  const Vector weight = sampled.sampling->weight;
  u.array() -= weight.dot(u) / weight.sum();
  return 2 * pi / std::sqrt(u.dot(*run.space().stiffness() * u) / u.dot(*sampled.mass * u));
}

TEST(SolidGrowth, WavelengthsAreThoseOfTheory) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=2000");
  for (const char* model : {"swift-hohenberg", "turing"}) {
    SolidRun run(
        make_program(recipe("solid = true\n[stage]\nmodel = \"" + std::string(model) + "\"\nsize = 0.2\n"), sphere));
    run.advance(80);
    EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
    EXPECT_NEAR(wavelength(run, 0) / run.program().stages[0].size, 1, 0.07) << model;
  }
}

TEST(SolidGrowth, CheckpointsKnowTheirVolume) {
  const std::string text = "solid = true\n[stage]\nmodel = \"turing\"\nsize = 0.3\nsteps = 6\n";
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=500");
  SolidRun whole(make_program(recipe(text), sphere)), half(make_program(recipe(text), sphere));
  whole.advance(6);
  half.advance(3);
  SolidRun rest(make_program(recipe(text), sphere));
  rest.restore(half.checkpoint());
  rest.advance(3);
  EXPECT_EQ(rest.coefficients()[0], whole.coefficients()[0]);
  SolidRun other(make_program(recipe(text), builtin_shape("builtin:sphere?n=600")));
  EXPECT_THROW(other.restore(half.checkpoint()), Error);
}

}  // namespace
}  // namespace pelage
