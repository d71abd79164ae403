// Coats on cells: as large as on other methods, over cracks, and on clouds of points.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "catalog/bind.h"
#include "discretise/anisotropy.h"
#include "look/dress.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "run/run.h"
#include "shape/cell_shapes.h"
#include "shape/cells.h"
#include "support/soups.h"

namespace pelage {
namespace {

using CoatRun = Run;  // in a test, Run is a function of its own

Recipe recipe(const std::string& stage) { return parse_recipe("[stage]\n" + stage, "test"); }

CoatRun grown(const TriangleMesh& shape, const std::string& stage) {
  CoatRun run(make_program(recipe(stage), shape));
  while (!run.done()) run.advance(100);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  EXPECT_FALSE(run.uniform());
  return run;
}

double wavelength(const CoatRun& run) {
  const auto& space = run.space();
  return measured_wavelength(*space.sampled(SampleRule::vertices).mass, *space.stiffness(), run.coefficients()[0]);
}

const std::string spots = "model = \"turing\"\nsize = 0.08\n";

TEST(CellsGrowth, SpotsAreAsFarApartAsOnLoopElements) {
  for (const char* name : {"builtin:sphere?n=2562", "builtin:animal?n=3000"}) {
    const TriangleMesh shape = load_shape(name);
    const double loop = wavelength(grown(shape, spots + "method = \"loop\"\n"));
    const double cells = wavelength(grown(shape, spots + "method = \"cells\"\n"));
    const double turk = wavelength(grown(shape, spots + "method = \"turk-cells\"\n"));
    RecordProperty(std::string("cells over loop on ") + name, std::to_string(cells / loop));
    RecordProperty(std::string("turk over loop on ") + name, std::to_string(turk / loop));
    EXPECT_NEAR(cells / loop, 1, 0.05) << name;
    EXPECT_NEAR(turk / loop, 1, 0.15) << name;
  }
}

/// Mean square of the slope to the neighbours, of cells that are within a cell of a crack and of all others.
std::pair<double, double> roughness(const CoatRun& run, const std::function<bool(const Point&)>& at_crack) {
  const Cells& cells = *as<Cells>(run.program().nodes);
  const CellShapes shapes(cells);
  CellShapes::Scratch scratch;
  const Vector& u = run.coefficients()[0];
  std::array<double, 2> sum{}, count{};
  for (std::size_t i = 0; i < cells.nodes(); ++i)
    for (const PlaneCell::Beyond& b : shapes.shape(i, scratch).beyond) {
      if (b.cell < 0) continue;
      const bool crack = at_crack(cells.points[i]);
      const double slope = (u[b.cell] - u[static_cast<Eigen::Index>(i)]) / b.distance;
      sum[crack] += slope * slope;
      ++count[crack];
    }
  return {sum[1] / count[1], sum[0] / count[0]};
}

/// The pattern goes on over cracks and T-junctions as if they were not there.
TEST(CellsGrowth, CrossesCracks) {
  const CoatRun flat = grown(square_with_t_junctions(), "model = \"turing\"\nsize = 0.06\nmethod = \"cells\"\n");
  const double radius = as<Cells>(flat.program().nodes)->radius;
  const auto [at_crack, inside] = roughness(flat, [&](const Point& p) { return std::abs(p[0] - 1) < radius; });
  EXPECT_NEAR(at_crack / inside, 1, 0.25);
  EXPECT_NEAR(wavelength(flat) / flat.stage_program().size, 1, 0.15);
  const CoatRun cube = grown(six_squares(), "model = \"turing\"\nsize = 0.07\nmethod = \"cells\"\n");
  const double r = as<Cells>(cube.program().nodes)->radius;
  const auto [at_edges, on_faces] = roughness(cube, [&](const Point& p) {
    int near = 0;
    for (const double x : p) near += std::min(std::abs(x), std::abs(1 - x)) < r;
    return near > 1;
  });
  EXPECT_NEAR(at_edges / on_faces, 1, 0.25);
}

/// A coat of a cloud is as large as that of the mesh whose points it has, and comes back at the points themselves.
TEST(CellsGrowth, CloudsGetTheCoatOfTheirSurface) {
  const TriangleMesh mesh = load_shape("builtin:animal?n=12000"), cloud = cloud_of(mesh);
  const double on_mesh = wavelength(grown(mesh, spots + "method = \"cells\"\n"));
  const CoatRun run = grown(cloud, spots);
  EXPECT_EQ(run.program().method->name, "cells");
  EXPECT_NEAR(wavelength(run) / on_mesh, 1, 0.05);
  const TriangleMesh coat = dress(run.fields(), Look{});
  EXPECT_EQ(coat.points, cloud.points);
  EXPECT_TRUE(coat.triangles.empty());
  EXPECT_EQ(coat.find("color")->values.size(), 3 * coat.points.size());
}

TEST(CellsGrowth, KeepsTheVerticesOfAMesh) {
  const TriangleMesh mesh = load_shape("builtin:sphere?n=2562");
  const CoatRun run = grown(mesh, "model = \"turing\"\nsize = 0.2\ncells = 2000\n");
  EXPECT_EQ(as<Cells>(run.program().nodes)->nodes(), 2000u);
  Look look;
  look.keep_shape = true;
  const TriangleMesh kept = dress(run.fields(), look);
  EXPECT_EQ(kept.points, mesh.points);
  EXPECT_EQ(kept.triangles, mesh.triangles);
  EXPECT_GT(dress(run.fields(), Look{}).points.size(), mesh.points.size());
}

/// Lines around an axis are found where nothing is said, and an axis is followed.
TEST(CellsGrowth, AnisotropicModelsFollowDirections) {
  for (const char* directions : {"", "directions = { axis = [0, 1, 0] }\n"}) {
    CoatRun run(make_program(
        recipe("model = \"witkin-kass-stripes\"\nsize = 0.2\nmethod = \"cells\"\n" + std::string(directions)),
        load_shape("builtin:sphere?n=2562")));
    run.advance(60);
    EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
    EXPECT_FALSE(run.uniform());
  }
}

void refused(const std::string& stage, const TriangleMesh& shape, const std::string& what) {
  try {
    make_program(recipe("model = \"turing\"\n" + stage), shape);
    ADD_FAILURE() << stage;
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
  }
}

TEST(CellsGrowth, SaysWhatItCannotDo) {
  const TriangleMesh sphere = load_shape("builtin:sphere?n=642");
  refused("method = \"loop\"\ncells = 500\n", sphere, "has no cells");
  refused("cells = 3\n", sphere, "16 to");
  refused("method = \"loop\"\n", cloud_of(sphere), "take \"cells\"");
  refused("method = \"cells\"\nsize = 0.0001\n", sphere, "too fine");
  refused("", TriangleMesh{{}, {}, {}}, "points");
}

}  // namespace
}  // namespace pelage
