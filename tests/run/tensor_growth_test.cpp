// Diffusion tensors given by formulas, and vectors as species.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "base/number.h"
#include "catalog/bind.h"
#include "catalog/models.h"
#include "direction/direction_field.h"
#include "discretise/surface_space.h"
#include "run/run.h"
#include "shape/generators.h"
#include "shape/grid.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own
using std::numbers::pi;

constexpr double coarse = 100;  // a size that leaves the mesh of the shape as it is

Recipe recipe_of(const std::string& species, const std::string& method = "loop") {
  Recipe recipe;
  recipe.models["test.toml"].text = "name = 'test'\nwavelength = " + number(coarse) + "\n" + species;
  Stage& stage = recipe.stages[0];
  stage.model.value = "test.toml";
  stage.size = Given<Length>{{coarse, Length::Unit::world}, {}};
  stage.interpolate = true;
  stage.method.value = method;
  stage.step = 0.01;
  stage.until = 0.5;
  return recipe;
}

Growth grown(const Recipe& recipe, const TriangleMesh& mesh) {
  Growth run(make_program(recipe, mesh));
  while (!run.done()) run.advance(1000);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  return run;
}

TriangleMesh square(double side, int vertices) {
  TriangleMesh mesh = builtin_shape("builtin:plane?n=" + std::to_string(vertices));
  for (Point& p : mesh.points) p = {side * p[0], side * p[1], 0};
  return mesh;
}

std::string entry(const char* name, double value) { return std::string(name) + " = " + exact_number(value) + ", "; }

std::string tensor_text(const Eigen::Matrix3d& t) {
  return "tensor = { " + entry("xx", t(0, 0)) + entry("xy", t(0, 1)) + entry("xz", t(0, 2)) + entry("yy", t(1, 1)) +
         entry("yz", t(1, 2)) + "zz = " + exact_number(t(2, 2)) + " }\n";
}

/// Root mean square of the difference from an exact field, relative to that of the field.
double error_of(const Growth& run, const std::function<double(const Point&)>& exact) {
  const Sampling& s = *run.system().sampling;
  const Vector u = s.values * run.coefficients()[0];
  double difference = 0, size = 0;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double f = exact(s.position[static_cast<std::size_t>(i)]);
    difference += s.weight[i] * (u[i] - f) * (u[i] - f);
    size += s.weight[i] * f * f;
  }
  return std::sqrt(difference / size);
}

class TensorOfEveryMethod : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, TensorOfEveryMethod, ::testing::Values("loop", "linear"),
                         [](const auto& name) { return name.param; });

/// A drop of covariance S becomes one of S + 2 T t; the order is that of the elements.
TEST_P(TensorOfEveryMethod, SpreadsADropAlongItsAxes) {
  Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
  t.topLeftCorner<2, 2>() << 0.04, 0.015, 0.015, 0.01;
  const double spread = 0.04;
  const std::string model = "[species.u]\nrate = 0\n" + tensor_text(t) + "initial = 'exp(-((x - 2)^2 + (y - 2)^2)/(2*" +
                            number(spread) + "))'";
  const Eigen::Matrix2d s = spread * Eigen::Matrix2d::Identity() + 2 * 0.5 * t.topLeftCorner<2, 2>();
  const auto exact = [&](const Point& p) {
    const Eigen::Vector2d r(p[0] - 2, p[1] - 2);
    return spread / std::sqrt(s.determinant()) * std::exp(-0.5 * r.dot(s.inverse() * r));
  };
  std::array<double, 2> error{};
  for (std::size_t k = 0; k < 2; ++k)
    error[k] = error_of(grown(recipe_of(model, GetParam()), square(4, k == 0 ? 1600 : 6400)), exact);
  RecordProperty("order", number(std::log2(error[0] / error[1])));
  EXPECT_LT(error[1], 5e-3);
  EXPECT_GT(std::log2(error[0] / error[1]), GetParam() == "loop" ? 3.2 : 1.9);
}

/// Along the circles of latitude, (-y, x, 0), nothing else diffuses: x^2 - y^2 decays by exp(-4 D t), z stays.
TEST_P(TensorOfEveryMethod, SpreadsAlongCirclesOfASphere) {
  const std::string tensor = "tensor = { xx = '0.5*y^2', xy = '-0.5*x*y', yy = '0.5*x^2', zz = 0 }\nrate = 0\n";
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=2562");
  const Growth run = grown(recipe_of("[species.u]\ninitial = 'x^2 - y^2'\n" + tensor, GetParam()), sphere);
  EXPECT_LT(error_of(run, [](const Point& p) { return std::exp(-4 * 0.5 * 0.5) * (p[0] * p[0] - p[1] * p[1]); }), 5e-3);
  const Growth still = grown(recipe_of("[species.u]\ninitial = 'z'\n" + tensor, GetParam()), sphere);
  EXPECT_LT(error_of(still, [](const Point& p) { return p[2]; }), 1e-3);
}

/// Entries of the stiffness of the first species, with its diffusion.
std::vector<double> stiffness(const Recipe& recipe, const TriangleMesh& mesh) {
  const Growth run(make_program(recipe, mesh));
  const Species& u = run.system().species[0];
  std::vector<double> values = u.stiffness->value;
  for (double& v : values) v *= u.diffusion;
  return values;
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  const double size = *std::ranges::max_element(a);
  for (std::size_t k = 0; k < a.size(); ++k) ASSERT_NEAR(a[k], b[k], 1e-12 * size);
}

/// What stands across the surface does nothing: D and D I + c n n' are the same.
TEST_P(TensorOfEveryMethod, ActsAlongTheSurfaceOnly) {
  const TriangleMesh animal = builtin_shape("builtin:animal?n=500");
  const auto of = [&](const std::string& diffusion) {
    return stiffness(recipe_of("[species.u]\nrate = 0\ninitial = 'x'\n" + diffusion, GetParam()), animal);
  };
  const std::vector<double> scalar = of("diffusion = 0.3");
  expect_same(scalar, of("tensor = { xx = 0.3, yy = 0.3, zz = 0.3 }"));
  expect_same(scalar, of("tensor = { xx = '0.3 + 2*nx^2', xy = '2*nx*ny', xz = '2*nx*nz', yy = '0.3 + 2*ny^2', "
                         "yz = '2*ny*nz', zz = '0.3 + 2*nz^2' }"));
}

/// Shape, tensor and start turned together.
TEST_P(TensorOfEveryMethod, TurnsWithTheShape) {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ())).matrix();
  Eigen::Matrix3d t;
  t << 0.05, 0.02, 0.01, 0.02, 0.03, 0, 0.01, 0, 0.01;
  const auto finished = [&](const Eigen::Matrix3d& r) {
    TriangleMesh torus = builtin_shape("builtin:torus?n=800");
    for (Point& p : torus.points) {
      const Eigen::Vector3d q = r * Eigen::Vector3d(p[0], p[1], p[2]);
      p = {q[0], q[1], q[2]};
    }
    const Eigen::Vector3d k = r * Eigen::Vector3d(1, 2, -1);
    Recipe recipe =
        recipe_of("[species.u]\nrate = 0\n" + tensor_text(r * t * r.transpose()) + "initial = 'sin(" +
                      exact_number(k[0]) + "*x + " + exact_number(k[1]) + "*y + " + exact_number(k[2]) + "*z)'",
                  GetParam());
    recipe.stages[0].stepper.value = "sbdf2";
    const Growth run = grown(recipe, torus);
    const Vector& u = run.coefficients()[0];
    return dot(u, *run.system().mass * u);
  };
  const double still = finished(Eigen::Matrix3d::Identity());
  EXPECT_NEAR(finished(turn) / still, 1, 1e-6);
}

/// Directions with two rates are the same tensor.
TEST_P(TensorOfEveryMethod, IsThatOfDirectionsWithTwoRates) {
  TriangleMesh mesh = square(2, 400);
  Attribute lines{direction_attribute, 3, Domain::vertex, {}};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) lines.values.insert(lines.values.end(), {1, 0, 0});
  mesh.set(lines);
  const double theta = 0.4, a1 = 0.3, a2 = 0.1;
  const Eigen::Vector3d d(std::cos(theta), std::sin(theta), 0);
  const Eigen::Matrix3d t = a2 * a2 * Eigen::Matrix3d::Identity() + (a1 * a1 - a2 * a2) * d * d.transpose();
  const auto of = [&](const std::string& diffusion) {
    return stiffness(recipe_of("[species.u]\nrate = 0\n" + diffusion, GetParam()), mesh);
  };
  expect_same(of("anisotropy = { theta = 0.4, a1 = 0.3, a2 = 0.1 }"), of(tensor_text(t)));
}

/// C0 stands before a tensor as before a number.
TEST_P(TensorOfEveryMethod, HasItsFactor) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=642");
  const auto of = [&](const std::string& diffusion) {
    const Growth run(make_program(recipe_of("[species.u]\nrate = 0\ninitial = 'x'\n" + diffusion, GetParam()), sphere));
    return run.system().species[0].mass->value;
  };
  expect_same(of("C0 = '2 + x'\nC1 = 0.3"), of("C0 = '2 + x'\ntensor = { xx = 0.3, yy = 0.3, zz = 0.3 }"));
  const auto constant = [&](const std::string& diffusion) {
    return stiffness(recipe_of("[species.u]\nrate = 0\n" + diffusion, GetParam()), sphere);
  };
  expect_same(constant("diffusion = 0.6"), constant("C0 = 2\ntensor = { xx = 0.3, yy = 0.3, zz = 0.3 }"));
}

/// Of time and of concentrations, as numbers are.
TEST(Tensor, FollowsTimeAndConcentrations) {
  const TriangleMesh mesh = square(2, 400);
  for (const std::string d : {"0.05*(1 + sin(3*t))", "0.02 + 0.05*u^2"}) {
    const std::string start = "[species.u]\nrate = 0\ninitial = 'cos(pi*x)*cos(pi*y)'\n";
    const Growth scalar = grown(recipe_of(start + "diffusion = '" + d + "'"), mesh),
                 tensor = grown(recipe_of(start + "tensor = { xx = '" + d + "', yy = '" + d + "', zz = 0 }"), mesh);
    const Vector &a = scalar.coefficients()[0], &b = tensor.coefficients()[0];
    EXPECT_LT((a - b).norm(), 1e-6 * a.norm()) << d;
    EXPECT_LT(a.norm(), 0.9 * std::sqrt(static_cast<double>(a.size())) / 2) << "has spread";
  }
}

/// Along a field of an earlier stage.
TEST(Tensor, ReadsEarlierStages) {
  Recipe recipe = recipe_of("[species.d]\nrate = 0\ndiffusion = 0\ninitial = 0.04");
  recipe.stages[0].name.value = "first";
  recipe.stages[0].until = 0.01;
  const Recipe second = recipe_of(
      "[species.u]\nrate = 0\ntensor = { xx = 'r', yy = 0, zz = 0 }\ninitial = 'cos(pi*x) + cos(pi*y)'\n"
      "[parameters]\nr = 1");
  recipe.models["second.toml"] = second.models.at("test.toml");
  recipe.stages.push_back(second.stages[0]);
  recipe.stages[1].model.value = "second.toml";
  recipe.stages[1].name.value = "second";
  Stage::Setting& map = recipe.stages[1].parameters.emplace_back();
  map.name = "r";
  map.formula = "first.d";
  const Growth run = grown(recipe, square(2, 900));
  const double left = std::exp(-0.04 * pi * pi * 0.5);
  EXPECT_LT(error_of(run, [&](const Point& p) { return left * std::cos(pi * p[0]) + std::cos(pi * p[1]); }), 5e-3);
}

/// Every species has its own, whether numbers or tensors.
TEST(Tensor, BelongsToItsSpecies) {
  const std::string model =
      "[species.a]\nrate = 0\ntensor = { xx = 0.1, yy = 0.1, zz = 0.1 }\n[species.b]\nrate = 0\ndiffusion = '0.2 + "
      "0*t'\n"
      "[species.c]\nrate = 0\ntensor = { xx = 0.3, yy = 0.3, zz = 0.3 }\n[species.d]\nrate = 0\ndiffusion = "
      "'0.1*exp(x)'\n"
      "[species.f]\nrate = 0\ndiffusion = '0.2*exp(x)'\n";
  const Growth run(make_program(recipe_of(model), builtin_shape("builtin:sphere?n=642")));
  const auto entry = [&](std::size_t i) {
    const Species& s = run.system().species[i];
    return s.diffusion * s.stiffness->value[0];
  };
  EXPECT_NEAR(entry(2) / entry(0), 3, 1e-12);
  EXPECT_NEAR(entry(1) / entry(0), 2, 1e-12);
  EXPECT_NEAR(entry(4) / entry(3), 2, 1e-12);
}

/// The only stage of a model on a shape that is nodes.
Program on_nodes(const NodeShape& nodes, TriangleMesh mesh, const Method& method, const StepperKind& stepper,
                 const std::string& species) {
  Program program;
  program.method = &method;
  program.shape = std::make_shared<const TriangleMesh>(std::move(mesh));
  program.nodes = std::make_shared<const NodeShape>(nodes);
  StageProgram& stage = program.stages.emplace_back();
  stage.model = compile(parse_model("name = 'test'\nwavelength = 1\n" + species, "test.toml"));
  stage.stepper = &stepper;
  stage.size = stage.length_unit = 1;
  stage.step = stage.suggested_step = 0.01;
  stage.until = 0.5;
  return program;
}

/// On an even periodic grid waves decay by k . T k: exactly where steppers need no matrix, and in second order by
/// elements. What is across the grid does nothing.
TEST(Tensor, DecaysWavesOnGrids) {
  const std::string model =
      "[species.u]\nrate = 0\ntensor = { xx = 0.04, xy = 0.015, yy = 0.01, xz = 0.001, yz = 0, zz = 1 }\n"
      "initial = 'sin(2*pi*(x + 2*y))'";
  const double left = std::exp(-0.5 * 4 * pi * pi * (0.04 + 4 * 0.015 + 4 * 0.01));
  const auto error = [&](const StepperKind& stepper, std::int32_t n) {
    Grid g;
    g.count = {n, n, 1};
    g.periodic = {true, true, false};
    g.spacing = {1.0 / n, 1.0 / n, 1};
    Program p = on_nodes(g, mesh_of(g), grid_method, stepper, model);
    p.stages[0].step = 0.0025;  // so that the error is that of the grid
    Growth run(std::move(p));
    while (!run.done()) run.advance(100);
    const std::vector<Point> place = run.space().geometry(SampleRule::vertices, false).position;
    double largest = 0;
    for (std::size_t i = 0; i < place.size(); ++i)
      largest = std::max(largest, std::abs(run.coefficients()[0][static_cast<Eigen::Index>(i)] -
                                           left * std::sin(2 * pi * (place[i][0] + 2 * place[i][1]))));
    return largest / left;
  };
  EXPECT_LT(error(etd, 32), 1e-9);
  EXPECT_LT(error(sbdf2, 128), 0.02);
  EXPECT_NEAR(error(sbdf2, 64) / error(sbdf2, 128), 4, 0.5);
}

/// In volumes all of it acts: x^2 + 2 y^2 + 3 z^2 grows by 2 (Txx + 2 Tyy + 3 Tzz) t until the skin is felt.
TEST(Tensor, FillsVolumes) {
  Grid g;
  g.count = {17, 17, 17};
  g.spacing = {1.0 / 16, 1.0 / 16, 1.0 / 16};
  const auto middle = [&](const std::string& tensor) {
    Program p = on_nodes(g, mesh_of(g), grid_method, sbdf2,
                         "[species.u]\nrate = 0\ninitial = '(x - 0.5)^2 + 2*(y - 0.5)^2 + 3*(z - 0.5)^2'\n" + tensor);
    p.stages[0].until = 0.1;
    Growth run(std::move(p));
    while (!run.done()) run.advance(100);
    return run.coefficients()[0][(17 * 8 + 8) * 17 + 8];
  };
  EXPECT_NEAR(middle("tensor = { xx = 0.02, yy = 0, zz = 0 }"), 2 * 0.02 * 0.1, 1e-4);
  EXPECT_NEAR(middle("tensor = { xx = 0, yy = 0.02, zz = 0 }"), 2 * 2 * 0.02 * 0.1, 1e-4);
  EXPECT_NEAR(middle("tensor = { xx = 0, yy = 0, zz = 0.02 }"), 2 * 3 * 0.02 * 0.1, 1e-4);
}

std::string refusal(const std::string& species) {
  try {
    const Growth run(make_program(recipe_of("[species.u]\nrate = 0\n" + species), square(2, 100)));
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "not refused: " << species;
  return "";
}

TEST(Tensor, RefusesWhatGathersAndWhatContradicts) {
  const auto says = [](const std::string& species, const char* what) {
    EXPECT_NE(refusal(species).find(what), std::string::npos) << refusal(species);
  };
  says("tensor = { xx = 1, yy = 1, zz = 1, xy = 1.1 }", "semidefinite");
  says("tensor = { xx = '1 - x', yy = 1, zz = 1 }", "semidefinite");
  says("tensor = { xx = 1, yy = 1 }", "zz");
  says("tensor = { xx = 1, yy = 1, zz = 1, yx = 1 }", "yx");
  says("tensor = { xx = 1, yy = 1, zz = 1 }\ndiffusion = 1", "not both");
  says("tensor = { xx = 1, yy = 1, zz = 1 }\nC1 = 1", "not both");
  says("tensor = { xx = 1, yy = 1, zz = 1 }\nanisotropy = { a1 = 1, a2 = 1 }", "not both");
  says("tensor = { xx = 'lap(u)', yy = 1, zz = 1 }", "lap()");
}

TEST(Tensor, WarnsOfRatiosThatTheMeshCannotCarry) {
  const auto warnings = [](const char* xx) {
    const Growth run(make_program(
        recipe_of("[species.u]\nrate = 0\ntensor = { xx = " + std::string(xx) + ", yy = 1, zz = 1 }"), square(2, 100)));
    return run.warnings().size();
  };
  EXPECT_EQ(warnings("4"), 0U);
  EXPECT_EQ(warnings("1600"), 1U);
}

// --- vectors -----------------------------------------------------------------------------------------------------

/// A vector is three species, to the bit.
TEST(Vectors, AreTheirThreeComponents) {
  const std::string diffusion = "tensor = { xx = '0.02 + 0.01*x', yy = 0.02, zz = 0.01, xy = 0.005 }\n";
  const std::string vector =
      "[species.u]\nvector = true\n" + diffusion +
      "rate = 'u - dot(u, u)*u + cross(u, w)'\ninitial = '0.1*noise(1)'\n"
      "[species.v]\nvector = true\ndiffusion = 0.01\nrate = ['u_1 - v_1', 'norm(u)', '-v_3 + grad2(u)']\n"
      "initial = ['x', '0.5', 'y']\n[definitions]\nw = ['0.2', 'y', 'x*y']\n";
  std::string scalars;
  const std::array<std::string, 3> cross = {"(u_2*w_3 - u_3*w_2)", "(u_3*w_1 - u_1*w_3)", "(u_1*w_2 - u_2*w_1)"},
                                   rate = {"u_1 - v_1", "sqrt(u_1*u_1 + u_2*u_2 + u_3*u_3)",
                                           "-v_3 + (grad2(u_1) + grad2(u_2) + grad2(u_3))"},
                                   initial = {"x", "0.5", "y"};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string n = std::to_string(k + 1);
    scalars += "[species.u_" + n + "]\n" + diffusion + "rate = 'u_" + n + " - (u_1*u_1 + u_2*u_2 + u_3*u_3)*u_" + n +
               " + " + cross[k] + "'\ninitial = '0.1*noise(1)'\n";
  }
  for (std::size_t k = 0; k < 3; ++k)
    scalars += "[species.v_" + std::to_string(k + 1) + "]\ndiffusion = 0.01\nrate = '" + rate[k] + "'\ninitial = '" +
               initial[k] + "'\n";
  scalars += "[definitions]\nw_1 = '0.2'\nw_2 = 'y'\nw_3 = 'x*y'\n";
  const TriangleMesh mesh = square(2, 400);
  const Growth a = grown(recipe_of(vector), mesh), b = grown(recipe_of(scalars), mesh);
  ASSERT_EQ(a.coefficients().size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(a.stage_program().model.species_name(i), b.stage_program().model.species_name(i));
    EXPECT_EQ(a.coefficients()[i], b.coefficients()[i]) << i;
  }
  EXPECT_EQ(a.system().species[0].stiffness, a.system().species[2].stiffness) << "is assembled once";
}

/// Sum over the triangles of how often arrows turn once around each, in its plane; and how many of them they do.
std::pair<int, int> indices(const Growth& run) {
  const std::vector<Point> place = run.space().geometry(SampleRule::vertices, false).position;
  std::array<Vector, 3> u;
  for (std::size_t k = 0; k < 3; ++k) u[k] = run.space().node_values() * run.coefficients()[k];
  int sum = 0, defects = 0;
  for (const Triangle& t : dynamic_cast<const SurfaceSpace&>(run.space()).discretisation().topology->triangles) {
    const auto at = [&](std::size_t corner) { return static_cast<std::size_t>(t[corner]); };
    const Point e = unit(difference(place[at(1)], place[at(0)]));
    const Point f = cross(unit(cross(e, difference(place[at(2)], place[at(0)]))), e);
    std::array<double, 3> angle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Point arrow{u[0][t[corner]], u[1][t[corner]], u[2][t[corner]]};
      angle[corner] = std::atan2(dot(f, arrow), dot(e, arrow));
    }
    double turned = 0;
    for (std::size_t corner = 0; corner < 3; ++corner)
      turned += std::remainder(angle[(corner + 1) % 3] - angle[corner], 2 * pi);
    const auto index = static_cast<int>(std::lround(turned / (2 * pi)));
    sum += index;
    defects += index != 0;
  }
  return {sum, defects};
}

/// The indices of a tangent field add up to the Euler characteristic (Poincare, Hopf); its arrows lie along the surface
/// and are 1 long but for defects.
TEST(Vectors, HaveTheDefectsThatTheSurfaceAsksFor) {
  for (const auto& [shape, euler] : {std::pair{"builtin:sphere?n=2562", 2}, {"builtin:torus?n=3000", 0}}) {
    Recipe recipe;
    recipe.stages[0].model.value = "polar-order";
    recipe.stages[0].size = Given<Length>{{0.5, Length::Unit::world}, {}};
    const Growth run = grown(recipe, builtin_shape(shape));
    const auto [sum, defects] = indices(run);
    EXPECT_EQ(sum, euler) << shape;
    EXPECT_GE(defects, euler);
    const PlaceGeometry at = run.space().geometry(SampleRule::vertices, false);
    double across = 0, length = 0;
    for (std::size_t v = 0; v < at.normal.size(); ++v) {
      const auto i = static_cast<Eigen::Index>(v);
      const Point arrow{run.coefficients()[0][i], run.coefficients()[1][i], run.coefficients()[2][i]};
      across += std::pow(dot(arrow, at.normal[v]), 2);
      length += dot(arrow, arrow);
    }
    EXPECT_LT(std::sqrt(across / length), 0.03) << shape;
    EXPECT_NEAR(length / static_cast<double>(at.normal.size()), 1, 0.25) << shape;
  }
}

}  // namespace
}  // namespace pelage
