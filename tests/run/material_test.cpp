#include "run/material.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "catalog/bind.h"
#include "run/run.h"
#include "shape/generators.h"

namespace pelage {
namespace {

/// A run of one species that starts as `initial` and stays so.
Run standing(const std::string& initial, TriangleMesh shape, const std::string& stepper = "sbdf2",
             const std::string& diffusion = "0", const std::string& method = "loop") {
  const auto path = std::filesystem::temp_directory_path() / "pelage_place_fields_test.toml";
  std::ofstream(path) << "name = 'standing'\ntitle = 't'\ncite = 'c'\nsummary = 's'\nwavelength = 1\n[species.u]\n"
                      << "diffusion = '" << diffusion << "'\nrate = '0'\ninitial = '" << initial << "'\n";
  Recipe recipe;
  recipe.stages[0].model.value = path.string();
  recipe.stages[0].stepper.value = stepper;
  recipe.stages[0].method.value = method;
  recipe.stages[0].size = Given<Length>{{0.3}, {}};
  return Run(make_program(recipe, std::move(shape)));
}

TriangleMesh with_height(TriangleMesh mesh) {
  Attribute height{"height", 1, Domain::vertex, {}}, place{"place", 3, Domain::vertex, {}};
  for (const Point& p : mesh.points) {
    height.values.push_back(p[2]);
    place.values.insert(place.values.end(), p.begin(), p.end());
  }
  mesh.set(height);
  mesh.set(place);
  return mesh;
}

/// The field at the vertices.
Vector samples(const Run& run) { return run.system().sampling->values * run.coefficients()[0]; }

TEST(PlaceFields, GiveCurvaturesToFormulas) {
  const auto run = standing("k1*k2 + 10*H", builtin_shape("builtin:sphere?n=642"));
  const Point& place = run.system().sampling->position[0];
  const double radius = std::hypot(place[0], place[1], place[2]);
  // A few percent at the twelve vertices of valence 5, where the curvature of a Loop surface does not converge.
  const double expected = 1 / (radius * radius) + 10 / radius;
  const Vector u = samples(run);
  EXPECT_LT((u.array() / expected - 1).abs().maxCoeff(), 0.08);
  EXPECT_LT(std::sqrt((u.array() / expected - 1).square().mean()), 0.02);
}

TEST(PlaceFields, GiveAttributesOfTheMeshToFormulas) {
  const TriangleMesh mesh = with_height(builtin_shape("builtin:sphere?n=162"));
  const auto run = standing("attribute(height)", mesh), same = standing("attribute(place_3)", mesh);
  ASSERT_GT(run.world().levels(), 0);
  const Vector u = samples(run);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)  // the vertices of the shape come first
    EXPECT_NEAR(u[static_cast<Eigen::Index>(i)], mesh.points[i][2], 1e-9);
  EXPECT_LE(u.cwiseAbs().maxCoeff(), 1 + 1e-9);
  EXPECT_LT((samples(same) - u).norm(), 1e-12);
}

TEST(PlaceFields, NamesOfAttributesCountWithoutCase) {
  TriangleMesh mesh = with_height(builtin_shape("builtin:sphere?n=162"));
  const Vector u = samples(standing("attribute(height)", mesh));
  EXPECT_EQ(samples(standing("attribute(HEIGHT)", mesh)), u);
  EXPECT_EQ(samples(standing("attribute(Place_3)", mesh)), u);
  mesh.set({"Height", 1, Domain::vertex, std::vector<double>(mesh.points.size(), 7)});
  EXPECT_EQ(samples(standing("attribute(height)", mesh)), u);
  EXPECT_NEAR(samples(standing("attribute(Height)", mesh)).minCoeff(), 7, 1e-9);
  EXPECT_THROW(standing("attribute(HEIGHT)", mesh), Error);  // which of the two?
}

TEST(PlaceFields, OfAMeshOfItsOwnAreThoseOfThePlace) {
  const TriangleMesh mesh = with_height(builtin_shape("builtin:sphere?n=2562"));
  const auto height = standing("attribute(height)", mesh, "sbdf2", "0", "remeshed");
  const auto curved = standing("k1*k2 + 10*H", mesh, "sbdf2", "0", "remeshed");
  const Vector u = samples(height), k = samples(curved);
  const auto& position = height.system().sampling->position;
  for (std::size_t i = 0; i < position.size(); ++i) EXPECT_NEAR(u[static_cast<Eigen::Index>(i)], position[i][2], 5e-3);
  EXPECT_LT(std::sqrt((k.array() / 11 - 1).square().mean()), 0.03);
}

TEST(PlaceFields, GiveAttributesToDiffusionAndToThePapersScheme) {
  const TriangleMesh mesh = with_height(builtin_shape("builtin:sphere?n=162"));
  auto run = standing("attribute(height)", mesh, "semi-implicit", "0.001*(2 + attribute(height))");
  const double before = samples(run).cwiseAbs().maxCoeff();
  run.advance(3);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  EXPECT_LT(samples(run).cwiseAbs().maxCoeff(), before);
}

TEST(PlaceFields, UnknownAttributesAreRefusedBeforeAnyWork) {
  try {
    standing("attribute(hight)", with_height(builtin_shape("builtin:sphere?n=162")));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    EXPECT_NE(std::string(error.what()).find("did you mean \"height\""), std::string::npos) << error.what();
    EXPECT_EQ(error.where().line, 9) << error.what();
  }
}

}  // namespace
}  // namespace pelage
